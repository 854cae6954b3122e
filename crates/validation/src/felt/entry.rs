//! A hand that dips a ball into a pool and takes it out again.

use super::bench::{Bench, scripted, steady};
use super::ways::Way;
use super::{figures, pool};
use crate::run::Report;
use crate::{Case, Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_devices::Segment;

/// Highest and lowest place of the ball, in edges over the floor.
const HEIGHTS: [f64; 2] = [0.85, 0.35];
/// Highest speed of a motion of least jerk over its mean one.
const PEAK: f64 = 1.875;

pub(super) const CASE: Case = Case {
    name: "felt-entry",
    about: "a hand dips a ball into a pool and takes it out: error of size and direction",
    source: "the hand's path through a fluid stepped at 1 kHz that answers at once, mean over seeds",
    parameters: pool::PARAMETERS,
    length: "edge",
    cells: [pool::CELLS; 3],
    variants: &[&[("viscosity", "0.1")], &[("viscosity", "0.001")]],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    // The still force is that of the ball within the pool.
    let mut bench = Bench::new(setup, pool::scene(setup, DVec3::Y * HEIGHTS[1]))?;
    let mut measures = Vec::new();
    for way in bench.ways()? {
        measures.extend(dipped(&mut bench, &way)?);
    }
    Ok(bench.report(measures))
}

fn dipped(bench: &mut Bench<'_>, way: &Way) -> Result<Vec<Measure>, ValidationError> {
    let felt = bench.felt(way)?;
    let [high, low] = HEIGHTS.map(|h| DVec3::Y * (h * bench.setup.number("edge")));
    let duration_s = PEAK * high.distance(low) / bench.setup.number("speed");
    let to = |position| Segment::MoveTo { position, duration_s };
    let scene = scripted(&felt, high, &[to(low), Segment::Hold { duration_s: 0.3 }, to(high)], 0.2);
    let trace = bench.run(&scene)?;
    let truth = bench.truth_of(&trace)?;
    let (sent, mean) = (steady(&trace.sent), steady(&truth.mean));
    let figure = |name, unit, of: fn(&[DVec3], &[DVec3]) -> f64, [must, goal]: [f64; 2]| {
        let floor = truth.floor(|a, b| of(steady(a), steady(b)));
        let measure = Measure::zero(name, unit, of(sent, mean), 1.0).goal(must);
        bench.mark(measure, &scene, Some(floor), Some(goal))
    };
    Ok(vec![
        figure("force_error", "1", figures::force_error, [0.15, 0.07]),
        figure("direction_error_deg", "°", figures::direction_error_deg, [6.0, 3.0]),
    ])
}
