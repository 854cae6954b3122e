//! A steady jet on a ball that is held still.

use super::bench::{Bench, mean, ripple, scripted, steady, still_path};
use super::closed_loop::Trace;
use super::jet;
use super::{figures, ways::Way};
use crate::run::Report;
use crate::{Case, Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_engine::Scene;

pub(super) const CASE: Case = Case {
    name: "felt-jet",
    about: "a steady jet on a ball that a hand holds still: ripple of what is sent, steps at new models, both sides alike",
    source: "the hand's path through a fluid stepped at 1 kHz that answers at once, mean over seeds",
    parameters: jet::PARAMETERS,
    length: "diameter",
    cells: [jet::CELLS; 3],
    variants: &[
        &[("fluid_hz", "60"), ("backend", "cpu")],
        &[("fluid_hz", "30")],
        &[("fluid_hz", "125")],
        &[("fluid_hz", "250")],
        &[("backend", "analytic-jet")],
    ],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let mut bench = Bench::new(setup, jet::scene(setup))?;
    let mut measures = source(&mut bench)?;
    for way in bench.ways()? {
        let held = Held::by(&mut bench, &way)?;
        measures.extend(held.measures(&bench));
    }
    Ok(bench.report(measures))
}

/// The fluid's own force, before any coupling.
pub(super) fn source(bench: &mut Bench<'_>) -> Result<Vec<Measure>, ValidationError> {
    let scene = bench.scene.clone();
    let offset = bench.setup.number("offset");
    let mut at = |x: f64| bench.truth(&scene, &still_path(DVec3::X * x), 1);
    let still = at(0.0)?;
    let force = steady(&still.mean);
    let ripple = ripple(force) / mean(force).length();
    let sides = [at(offset)?, at(-offset)?].map(|t| mean(steady(&t.mean)).x);
    let ripple = Measure::zero("source_ripple", "1", ripple, 1.0).goal(0.05);
    let ripple = bench.mark(ripple, &scene, None, Some(0.01));
    Ok(if sides[0] == 0.0 { vec![ripple] } else { vec![ripple, symmetry(bench, &scene, sides)] })
}

fn symmetry(bench: &Bench<'_>, scene: &Scene, [a, b]: [f64; 2]) -> Measure {
    let measure = Measure::zero("side_symmetry", "1", (a + b).abs() / (a - b).abs(), 1.0).goal(0.05);
    bench.mark(measure, scene, None, Some(0.02))
}

/// `felt`, with a hand that holds still.
pub(super) fn script(_: &Setup<'_>, felt: &Scene) -> Scene {
    scripted(felt, DVec3::ZERO, &[], 1.0)
}

/// What the hand feels of it.
pub(super) struct Held {
    scene: Scene,
    trace: Trace,
}

impl Held {
    /// By `way`.
    pub fn by(bench: &mut Bench<'_>, way: &Way) -> Result<Self, ValidationError> {
        let scene = script(bench.setup, &bench.felt(way)?);
        let trace = bench.run(&scene)?;
        Ok(Self { scene, trace })
    }

    /// What was sent while the jet was steady, N.
    pub fn steady(&self) -> &[DVec3] {
        steady(&self.trace.sent)
    }

    pub fn measures(&self, bench: &Bench<'_>) -> Vec<Measure> {
        let (sent, fresh) = (self.steady(), steady(&self.trace.fresh));
        let mark = |m: Measure, goal| bench.mark(m, &self.scene, None, Some(goal));
        let step = figures::swap_step(sent, fresh, 0.95);
        vec![
            mark(Measure::zero("ripple_rms_N", "N", ripple(sent), 1.0).goal(5e-3), 2e-3),
            mark(Measure::zero("swap_step_N", "N", step, 1.0).goal(10e-3), 3e-3),
        ]
    }
}
