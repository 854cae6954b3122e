//! A hand that stirs a pool from rest, and stops.

use super::bench::{Bench, WARM_UP, scripted};
use super::ways::Way;
use super::{figures, pool};
use crate::run::Report;
use crate::{Case, Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_devices::Segment;
use hapflow_engine::Scene;
use std::f64::consts::TAU;

/// Radius of the circle, in edges, and height over the floor.
const PLACE: [f64; 2] = [0.22, 0.3];
/// Turns, and time at rest after them, s.
const TURNS: f64 = 2.0;
const REST: f64 = 0.8;
/// Shares of the speed through which the hand comes to it, and the time for each, s.
const RISE: [f64; 4] = [0.2, 0.4, 0.6, 0.8];
const RISE_S: f64 = 0.05;
/// Time after the stop in which the hand itself comes to rest, s.
const STOP: f64 = 0.1;

pub(super) const CASE: Case = Case {
    name: "felt-stir",
    about: "a hand stirs a pool from rest and stops: resistance that falls as the fluid spins up, swirl that carries, and its decay",
    source: "the hand's path through a fluid stepped at 1 kHz that answers at once, mean over seeds",
    parameters: pool::PARAMETERS,
    length: "edge",
    cells: [pool::CELLS; 3],
    variants: &[
        &[("viscosity", "0.1")],
        &[("viscosity", "0.001")],
        &[("viscosity", "1")],
        &[("viscosity", "10")],
    ],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let mut bench = Bench::new(setup, scene(setup))?;
    let mut measures = Vec::new();
    for way in bench.ways()? {
        measures.extend(stirred(&mut bench, &way)?);
    }
    Ok(bench.report(measures))
}

/// The pool, with the ball where the stirring begins.
pub(super) fn scene(setup: &Setup<'_>) -> Scene {
    pool::scene(setup, DVec3::new(PLACE[0], PLACE[1], 0.0))
}

/// Turns a second.
fn hz(setup: &Setup<'_>) -> f64 {
    setup.number("speed") / (TAU * PLACE[0] * setup.number("edge"))
}

/// `felt`, with a hand that stirs.
pub(super) fn script(setup: &Setup<'_>, felt: &Scene) -> Scene {
    let (edge, hz) = (setup.number("edge"), hz(setup));
    let circle = |share: f64, duration_s| {
        let centre = DVec3::Y * (PLACE[1] * edge);
        Segment::Circle { centre, frequency_hz: share * hz, duration_s }
    };
    let rise = RISE.map(|share| circle(share, RISE_S));
    let fall = RISE.map(|share| circle(1.0 - share, RISE_S));
    let segments = [&rise[..], &[circle(1.0, TURNS / hz)], &fall[..]].concat();
    scripted(felt, felt.tool.position, &segments, REST)
}

fn stirred(bench: &mut Bench<'_>, way: &Way) -> Result<Vec<Measure>, ValidationError> {
    let scene = script(bench.setup, &bench.felt(way)?);
    let trace = bench.run(&scene)?;
    let truth = bench.truth_of(&trace)?;
    let parts = Parts::new(1.0 / hz(bench.setup));
    let [sent, mean] = [&trace.sent, &truth.mean].map(|series| parts.forces(series, &trace.path));
    // Over the resistance at the beginning: in thick fluid what comes after is next to nothing.
    let scale = parts.resistance(&truth.mean, &trace.path).abs();
    let apart = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| (a[k] - b[k]).abs() / scale);
    let errors: [f64; 3] = apart(sent, mean);
    let floor =
        |k: usize| truth.floor(|a, b| apart(parts.forces(a, &trace.path), parts.forces(b, &trace.path))[k]);
    let worst = (0..3).max_by(|a, b| errors[*a].total_cmp(&errors[*b])).unwrap_or(0);
    // Water at a ball's scale resists by hardly more than its noise: it is told and not judged.
    let judged = bench.setup.number("viscosity") >= 0.1;
    let stir = Measure::zero("stir_error", "1", errors[worst], 1.0);
    let stir = if judged { stir.goal(0.15) } else { stir };
    let told =
        |name, k: usize| bench.mark(Measure::zero(name, "1", errors[k], 1.0), &scene, Some(floor(k)), None);
    let error = |a: &[DVec3], b: &[DVec3]| {
        let begin = (1e3 * WARM_UP) as usize;
        figures::force_error(&level(&a[begin..]), &level(&b[begin..]))
    };
    let whole = Measure::zero("force_error", "1", error(&trace.sent, &truth.mean), 1.0);
    Ok(vec![
        bench.mark(stir, &scene, Some(floor(worst)), judged.then_some(0.08)),
        told("spin_up_error", 0),
        told("carry_error", 1),
        told("decay_error", 2),
        bench.mark(whole, &scene, Some(truth.floor(error)), None),
    ])
}

/// What of a force is level: the lift is not of the stirring.
pub(super) fn level(series: &[DVec3]) -> Vec<DVec3> {
    series.iter().map(|f| DVec3::new(f.x, 0.0, f.z)).collect()
}

/// The parts of a stirring, ticks.
struct Parts {
    turn: usize,
    begin: usize,
    stop: usize,
}

impl Parts {
    fn new(turn_s: f64) -> Self {
        let rise_s = RISE_S * RISE.len() as f64;
        let (turn, begin) = ((1e3 * turn_s) as usize, (1e3 * (WARM_UP + rise_s)) as usize);
        Self { turn, begin, stop: begin + (TURNS * turn as f64) as usize }
    }

    /// By how much the resistance falls until the last turn; how the swirl pushes the hand that has stopped; and how it does a
    /// while later; N.
    fn forces(&self, series: &[DVec3], path: &[DVec3]) -> [f64; 3] {
        let last = along(series, path, self.stop - self.turn, self.stop);
        let still = self.stop + (1e3 * (RISE_S * RISE.len() as f64 + STOP)) as usize;
        let half = still + (series.len() - still) / 2;
        let carry = along(series, path, still, half);
        [last - self.resistance(series, path), carry, along(series, path, half, series.len())]
    }

    /// Mean force along the swirl in the first third of a turn, N.
    fn resistance(&self, series: &[DVec3], path: &[DVec3]) -> f64 {
        along(series, path, self.begin, self.begin + self.turn / 3)
    }
}

/// Mean force along the swirl from one tick to another, N.
fn along(series: &[DVec3], path: &[DVec3], from: usize, to: usize) -> f64 {
    let part = from..to.min(series.len());
    let ticks = part.len().max(1) as f64;
    part.map(|n| series[n].dot(swirl(path[n]))).sum::<f64>() / ticks
}

/// The way that the stirred fluid goes at `place`: from z towards x.
fn swirl(place: DVec3) -> DVec3 {
    DVec3::Y.cross(place).normalize_or_zero()
}
