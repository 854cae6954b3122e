//! A hand that crosses a jet.

use super::bench::{Bench, ripple, scripted, steady};
use super::closed_loop::Trace;
use super::figures;
use super::jet;
use super::truth::Truth;
use super::ways::Way;
use crate::run::Report;
use crate::{Case, Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_devices::Segment;
use hapflow_engine::Scene;

/// How far from the axis it begins and ends, in radii of ball and jet together.
const WIDTH: f64 = 1.8;
/// Highest speed of a motion of least jerk over its mean one.
const PEAK: f64 = 1.875;
/// Time after the crossing, s.
const HOLD: f64 = 0.1;

pub(super) const CASE: Case = Case {
    name: "felt-crossing",
    about: "a hand crosses a jet: error of size and direction, ripple and energy that the coupling adds",
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
    let baseline = Crossed::by(&mut bench, &Way::baseline()?)?;
    let mut measures = Vec::new();
    for way in bench.ways()? {
        let crossed = match way == Way::baseline()? {
            true => baseline.clone(),
            false => Crossed::by(&mut bench, &way)?,
        };
        measures.extend(crossed.measures(&bench, baseline.added_ripple()));
    }
    Ok(bench.report(measures))
}

/// `felt`, with a hand that crosses the jet.
pub(super) fn script(setup: &Setup<'_>, felt: &Scene) -> Scene {
    let side = WIDTH * (setup.number("tool_radius") + 0.5 * setup.number("diameter"));
    let duration_s = PEAK * 2.0 * side / setup.number("crossing_speed");
    let across = Segment::MoveTo { position: DVec3::X * side, duration_s };
    scripted(felt, DVec3::NEG_X * side, &[across], HOLD)
}

/// A crossing, and what it should have been.
#[derive(Clone)]
pub(super) struct Crossed {
    scene: Scene,
    trace: Trace,
    truth: Truth,
}

impl Crossed {
    /// By `way`.
    pub fn by(bench: &mut Bench<'_>, way: &Way) -> Result<Self, ValidationError> {
        let scene = script(bench.setup, &bench.felt(way)?);
        let trace = bench.run(&scene)?;
        let truth = bench.truth_of(&trace)?;
        Ok(Self { scene, trace, truth })
    }

    /// What was sent after the warm-up, and what should have been, N.
    pub fn forces(&self) -> [&[DVec3]; 2] {
        [steady(&self.trace.sent), steady(&self.truth.mean)]
    }

    /// What the hand felt above 20 Hz that the truth does not have, N. What scatter the mean of the seeds has left is
    /// taken off.
    pub fn added_ripple(&self) -> f64 {
        let added = ripple(&figures::difference(steady(&self.trace.sent), steady(&self.truth.mean)));
        let seeds = self.truth.seeds.len() as f64;
        // A seed against the mean of the others: its own scatter, and theirs.
        let apart = self.truth.floor(|a, b| ripple(&figures::difference(steady(a), steady(b))).powi(2));
        let left = apart * (seeds - 1.0) / seeds / seeds;
        (added.powi(2) - left).max(0.0).sqrt()
    }

    pub fn measures(&self, bench: &Bench<'_>, baseline: f64) -> Vec<Measure> {
        let [sent, truth] = self.forces();
        let path = &self.trace.path[self.trace.path.len() - sent.len() - 1..];
        let floor = |figure: &dyn Fn(&[DVec3], &[DVec3]) -> f64| {
            Some(self.truth.floor(|a, b| figure(steady(a), steady(b))))
        };
        let mark = |m: Measure, floor, goal| bench.mark(m, &self.scene, floor, goal);
        let zero = |name, unit, value| Measure::zero(name, unit, value, 1.0);
        let hz = self.scene.run.fluid_hz;
        // The table's figures for the error are those of 60 and 125 Hz.
        let limits = if hz == 60.0 {
            Some([0.15, 0.07])
        } else if hz == 125.0 {
            Some([0.08, 0.04])
        } else {
            None
        };
        let error = zero("force_error", "1", figures::force_error(sent, truth));
        let error = limits.map_or(error.clone(), |l| error.goal(l[0]));
        let angle = zero("direction_error_deg", "°", figures::direction_error_deg(sent, truth)).goal(6.0);
        let ratio = zero("ripple_ratio", "1", self.added_ripple() / baseline).goal(0.5);
        let [net, up] = figures::energy(sent, truth, path);
        let work = |a: &[DVec3], b: &[DVec3]| figures::energy(a, b, path)[1];
        let still = floor(&work).unwrap_or(0.0);
        let energy = zero("energy_true_J", "J", (net.abs().max(up) - still).max(0.0)).goal(2e-3);
        let ripple = |a: &[DVec3], b: &[DVec3]| ripple(&figures::difference(a, b)) / baseline;
        vec![
            mark(error, floor(&figures::force_error), limits.map(|l| l[1])),
            mark(angle, floor(&figures::direction_error_deg), Some(3.0)),
            mark(ratio, floor(&ripple), Some(0.25)),
            mark(energy, Some(still), Some(0.5e-3)),
        ]
    }
}
