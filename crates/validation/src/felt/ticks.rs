//! What a servo tick costs, in the fluid and out of it.

use super::bench::{Bench, WARM_UP, open_gate};
use super::closed_loop::ClosedLoop;
use super::jet;
use super::ways::Way;
use crate::run::Report;
use crate::{Case, Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_engine::{Scene, SessionOptions, VirtualPace, run::TICK_S};
use hapflow_realtime::thread_cpu_ns;

/// Ticks that are timed, after a warm-up.
const TICKS: usize = 4000;
/// Where the tool is beside the jet, in its radii.
const BESIDE: f64 = 6.0;

pub(super) const CASE: Case = Case {
    name: "felt-tick",
    about: "CPU time of a servo tick in the jet and beside it",
    source: "the thread's own CPU clock, less what a look at it costs",
    parameters: jet::PARAMETERS,
    length: "diameter",
    cells: [jet::CELLS; 3],
    variants: &[],
    run: |setup| run(setup, &Way::named(setup.word("coupling"))?),
};

/// Of each of `ways`.
pub(super) fn run(setup: &Setup<'_>, ways: &[Way]) -> Result<Report, ValidationError> {
    let mut bench = Bench::unscaled(setup, jet::scene(setup));
    let mut measures = Vec::new();
    for way in ways {
        let mut scene = way.scene(&bench.scene, 1.0);
        open_gate(&mut scene);
        let contact = times(&mut bench, &scene)?;
        scene.tool.position = DVec3::X * (BESIDE * setup.number("tool_radius"));
        let idle = times(&mut bench, &scene)?;
        let mark = |name, seconds, [must, goal]: [f64; 2]| {
            bench.mark(Measure::zero(name, "s", seconds, 1.0).goal(must), &scene, None, Some(goal))
        };
        measures.extend([
            mark("tick_p50_s", quantile(&contact, 0.5), [10e-6, 2e-6]),
            mark("tick_p999_s", quantile(&contact, 0.999), [50e-6, 20e-6]),
            mark("tick_idle_p50_s", quantile(&idle, 0.5), [0.5e-6, 0.2e-6]),
        ]);
    }
    Ok(bench.report(measures))
}

/// The time of each tick of `scene`, s, the shortest first. The fluid runs between them, and leaves its data in the caches.
fn times(bench: &mut Bench<'_>, scene: &Scene) -> Result<Vec<f64>, ValidationError> {
    let mut felt = ClosedLoop::open(scene, SessionOptions { threads: 1, ..SessionOptions::hosted() })?;
    let mut pace = VirtualPace::new(scene);
    let look = look_ns();
    let mut times = Vec::with_capacity(TICKS);
    let first = (WARM_UP / TICK_S) as usize;
    for n in 0..first + TICKS {
        let time_s = n as f64 * TICK_S;
        pace.advance(&mut felt.fluid, time_s);
        let state = hapflow_haptics::ToolState::at(scene.tool.position);
        let begun = thread_cpu_ns();
        std::hint::black_box(felt.servo.tick(std::hint::black_box(&state), time_s, TICK_S));
        let taken = thread_cpu_ns() - begun;
        if n >= first {
            times.push(1e-9 * taken.saturating_sub(look) as f64);
        }
    }
    bench.lived_through(TICK_S * (first + TICKS) as f64);
    times.sort_by(f64::total_cmp);
    Ok(times)
}

/// What two looks at the clock take, ns.
fn look_ns() -> u64 {
    let mut looks: Vec<_> = (0..1001)
        .map(|_| {
            let begun = thread_cpu_ns();
            thread_cpu_ns() - begun
        })
        .collect();
    looks.sort_unstable();
    looks[looks.len() / 2]
}

fn quantile(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    sorted.get((share * last as f64) as usize).copied().unwrap_or(f64::NAN)
}
