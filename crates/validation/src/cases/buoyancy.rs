//! A ball at rest in a tank is carried by the weight of the water that it displaces, quietly.

use crate::case::{Case, Parameter};
use crate::reference::{GRAVITY, ball_volume};
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{BodySample, Shape};
use std::f64::consts::TAU;

/// Simulated time at rest, s.
const DURATION: f64 = 2.0;
/// Time of the stirring, which is a whole circle, s.
const STIRRING: f64 = 1.0;

pub(super) const CASE: Case = Case {
    name: "buoyancy",
    about: "a ball held at the centre of a cube of water: its force, how quiet that is, how soon it settles",
    source: "Archimedes: ρ g V",
    parameters: &[
        Parameter::number("radius", "m", "0.08", [0.005, 0.18], "Radius of the ball."),
        Parameter::number("side", "m", "0.4", [0.05, 2.0], "Side of the cube of water."),
        Parameter::DENSITY,
        Parameter::whole(
            "seed",
            "1",
            [1.0, 1e6],
            "Which of many equal starts: how the particles stand off the lattice.",
        ),
        Parameter::word(
            "start",
            "lattice",
            &["lattice", "packed", "stirred"],
            "lattice: no pressure yet; packed: as a scene starts, under pressure; stirred: after a circle of the ball.",
        ),
    ],
    length: "side",
    cells: [22.0, 25.0, 28.0],
    variants: &[
        &[("start", "lattice"), ("seed", "1")],
        &[("start", "lattice"), ("seed", "2")],
        &[("start", "lattice"), ("seed", "3")],
        &[("start", "lattice"), ("seed", "4")],
        &[("start", "lattice"), ("seed", "5")],
        &[("start", "packed"), ("seed", "1")],
        &[("start", "stirred"), ("seed", "1")],
    ],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (radius, side) = (setup.number("radius"), setup.number("side"));
    let mut world = worlds::tank(DVec3::splat(side));
    let centre = DVec3::Y * 0.5 * side;
    world.seed = setup.number("seed") as u32;
    world.bodies = vec![worlds::body(Shape::Sphere { radius }, centre)];
    let config = setup.config(world);
    let sound = config.sound_speed();
    let mut run = match setup.word("start") {
        "packed" => Run::start(setup, config)?,
        _ => Run::start_without_pressure(setup, config)?,
    };
    let lift = |output: &hapflow_fluid::FrameOutput| output.loads[0].force().y;
    let stirring = if setup.word("start") == "stirred" { STIRRING } else { 0.0 };
    run.record(stirring, |t| circle(centre, 0.1 * side, t), lift);
    let step = run.record(DURATION, |_| BodySample::at(centre), lift);
    let steady = stats::last(&step, 0.25);
    let mean = stats::mean(steady);
    let archimedes = run.config().settings.rest_density * GRAVITY * ball_volume(radius);
    let millisecond = stats::blocks(steady, run.steps_per_ms());
    // Quarter of a wave between the floor and the free surface.
    let settled = stats::settling_time(&step, 4.0 * side / sound, 5e-3 * archimedes) - stirring;
    Ok(run.report(vec![
        Measure::new("force", "N", mean, archimedes).goal(force_goal(radius / setup.dx)),
        Measure::zero("noise", "1", stats::deviation(steady) / mean, 1.0).goal(2e-3),
        Measure::zero("noise_1ms", "1", stats::deviation(&millisecond) / mean, 1.0).goal(2e-3),
        Measure::zero("settle_s", "s", settled.max(0.0), 1.0).goal(0.5),
    ]))
}

/// A ball of few spacings may be a little off.
fn force_goal(spacings: f64) -> f64 {
    // A radius that was given as a multiple of the spacing must not fall short by a rounding.
    let at_least = |n: f64| spacings > n - 1e-6;
    if at_least(4.0) {
        0.01
    } else if at_least(3.0) {
        0.02
    } else {
        0.04
    }
}

/// The stirring ball: once round a level circle through `centre`, starting and ending at rest.
fn circle(centre: DVec3, radius: f64, time: f64) -> BodySample {
    let share = (time / STIRRING).clamp(0.0, 1.0);
    let angle = TAU * (share - (TAU * share).sin() / TAU);
    let rate = TAU * (1.0 - (TAU * share).cos()) / STIRRING;
    BodySample {
        velocity: radius * rate * DVec3::new(angle.sin(), 0.0, angle.cos()),
        ..BodySample::at(centre + radius * DVec3::new(1.0 - angle.cos(), 0.0, angle.sin()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circle_closes_at_rest_and_its_velocity_is_its_slope() {
        let (c, r) = (DVec3::Y, 0.04);
        for t in [0.0, STIRRING] {
            let s = circle(c, r, t);
            assert!((s.position - c).length() < 1e-12 && s.velocity.length() < 1e-12);
        }
        let (a, b, e) = (circle(c, r, 0.3), circle(c, r, 0.3 + 1e-6), 1e-6);
        assert!(((b.position - a.position) / e - a.velocity).length() < 1e-5);
    }
}
