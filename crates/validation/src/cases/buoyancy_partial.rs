//! A ball that floats in part is carried by the weight of the water that its lower cap displaces.

use crate::case::{Case, Parameter};
use crate::reference::{GRAVITY, cap_volume};
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{BodySample, Shape};

/// Simulated time, s.
const DURATION: f64 = 2.0;

pub(super) const CASE: Case = Case {
    name: "buoyancy-partial",
    about: "a ball held in the surface of a cube of water",
    source: "Archimedes, for the spherical cap π h² (3R − h)/3",
    parameters: &[
        Parameter::number("radius", "m", "0.08", [0.005, 0.18], "Radius of the ball."),
        Parameter::number(
            "immersion",
            "",
            "0.5",
            [0.05, 1.0],
            "Depth of its lowest point over its diameter.",
        ),
        Parameter::number(
            "side",
            "m",
            "0.4",
            [0.05, 2.0],
            "Side of the cube of water, with the ball's cap in it.",
        ),
        Parameter::DENSITY,
    ],
    length: "side",
    cells: [22.0, 25.0, 28.0],
    variants: &[&[("immersion", "0.5")], &[("immersion", "0.25")], &[("immersion", "0.75")]],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (radius, side) = (setup.number("radius"), setup.number("side"));
    let depth = 2.0 * radius * setup.number("immersion");
    let place = DVec3::Y * (side - depth + radius);
    let mut world = worlds::tank(DVec3::splat(side));
    world.bodies = vec![worlds::body(Shape::Sphere { radius }, place)];
    let mut run = Run::start_without_pressure(setup, setup.config(world))?;
    let force = run.record(DURATION, |_| BodySample::at(place), |output| output.loads[0].force().y);
    let archimedes = setup.number("density") * GRAVITY * cap_volume(radius, depth);
    let mean = stats::mean(stats::last(&force, 0.25));
    Ok(run.report(vec![Measure::new("force", "N", mean, archimedes).goal(0.03)]))
}
