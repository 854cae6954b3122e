//! A ball that is shaken in water moves half of its own volume of water too, and a little more between walls.

use crate::case::{Case, Parameter};
use crate::reference::{added_mass_factor, ball_volume};
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{BodySample, Shape};
use std::f64::consts::TAU;

/// Frequency of the shaking, Hz: too fast for waves, whose first has about 1.4 Hz in the shipped tank.
const FREQUENCY: f64 = 5.0;
/// Time at rest, then time of shaking, which grows for a while; its last periods count. Whole numbers of periods, s.
const REST: f64 = 0.4;
const SHAKING: f64 = 1.4;
const GROWTH: f64 = 0.4;
const PERIODS: f64 = 4.0;

pub(super) const CASE: Case = Case {
    name: "added-mass",
    about: "a ball shaken sideways in the middle of a cube of water: force in step with its acceleration",
    source: "½ ρ V a, Lamb 1932, Hydrodynamics, 6th ed., §92, with the images of the ball in floor, walls and surface",
    parameters: &[
        Parameter::number("radius", "m", "0.08", [0.005, 0.15], "Radius of the ball."),
        Parameter::number("side", "m", "0.4", [0.05, 2.0], "Side of the cube of water."),
        Parameter::number("acceleration", "m/s²", "2", [0.1, 20.0], "Amplitude of the ball's acceleration."),
        Parameter::DENSITY,
    ],
    length: "side",
    cells: [22.0, 25.0, 28.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (radius, side) = (setup.number("radius"), setup.number("side"));
    let acceleration = setup.number("acceleration");
    let centre = DVec3::Y * 0.5 * side;
    let mut world = worlds::tank(DVec3::splat(side));
    world.bodies = vec![worlds::body(Shape::Sphere { radius }, centre)];
    let mut run = Run::start(setup, setup.config(world))?;
    run.record(REST, |_| BodySample::at(centre), |_| 0.0);
    let motion = |t: f64| shaken(centre, acceleration, t - REST);
    let force = run.record(SHAKING, motion, |output| output.loads[0].force().x);
    let steady = stats::last(&force, PERIODS / FREQUENCY / SHAKING);
    // ω REST is a whole number of turns.
    let [_, in_step] = stats::sine(steady, TAU * FREQUENCY);
    let reference =
        0.5 * setup.number("density") * ball_volume(radius) * acceleration * added_mass_factor(radius, side);
    Ok(run.report(vec![Measure::new("force", "N", in_step, reference).goal(0.10)]))
}

/// The ball `time` seconds after it began to be shaken round `centre`: in the end a = −`acceleration` sin ωt.
fn shaken(centre: DVec3, acceleration: f64, time: f64) -> BodySample {
    let (omega, u) = (TAU * FREQUENCY, (time / GROWTH).clamp(0.0, 1.0));
    let (grown, growing) = (u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / GROWTH);
    let (sin, cos) = (omega * time).sin_cos();
    let way = acceleration / (omega * omega);
    BodySample {
        velocity: DVec3::X * way * (growing * sin + grown * omega * cos),
        ..BodySample::at(centre + DVec3::X * way * grown * sin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shaking_s_velocity_is_the_slope_of_its_way() {
        for t in [0.05, 0.3, 0.9] {
            let (e, at) = (1e-6, |t| shaken(DVec3::Y, 2.0, t));
            let slope = (at(t + e).position - at(t - e).position) / (2.0 * e);
            assert!((slope - at(t).velocity).length() < 1e-6);
        }
        assert_eq!(shaken(DVec3::Y, 2.0, 0.0), BodySample::at(DVec3::Y));
    }
}
