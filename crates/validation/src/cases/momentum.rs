//! What a body takes from the water, the water has lost.

use crate::case::{Case, Parameter};
use crate::run::{Report, Run, vectors};
use crate::{Measure, Setup, ValidationError, worlds};
use glam::DVec3;
use hapflow_fluid::{Aabb, BodySample, Shape};

pub(super) const CASE: Case = Case {
    name: "momentum",
    about: "a ball driven into a cube of water that floats without gravity: impulse on it against the water's",
    source: "Newton's third law",
    parameters: &[
        Parameter::number("side", "m", "0.1", [0.01, 1.0], "Side of the cube of water."),
        Parameter::number(
            "speed",
            "m/s",
            "0.5",
            [0.05, 5.0],
            "Speed of the ball, of a radius of a quarter of the side.",
        ),
        Parameter::DENSITY,
    ],
    length: "side",
    cells: [14.0, 18.0, 24.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (side, speed) = (setup.number("side"), setup.number("speed"));
    let (half, radius) = (0.5 * side, 0.25 * side);
    let start = DVec3::new(-half - radius, 0.1 * side, 0.05 * side);
    let mut world = worlds::empty(Aabb { min: DVec3::splat(-8.0 * side), max: DVec3::splat(8.0 * side) });
    world.pools = vec![Aabb { min: DVec3::splat(-half), max: DVec3::splat(half) }];
    world.bodies = vec![worlds::body(Shape::Sphere { radius }, start)];
    let mut config = setup.config_at_speed(world, speed);
    config.settings.gravity = DVec3::ZERO;
    let mut run = Run::start(setup, config)?;
    let (mut impulse, mut pushed) = (DVec3::ZERO, 0.0);
    // Once through the water.
    while run.time() * speed < 2.0 * (half + radius) {
        let t = run.time() + run.dt();
        let ball = BodySample { velocity: DVec3::X * speed, ..BodySample::at(start + DVec3::X * speed * t) };
        let force = run.step(Some(vec![ball])).loads[0].force();
        impulse += force * run.dt();
        pushed += force.length() * run.dt();
    }
    let mass = run.config().settings.particle_mass();
    let water = mass * vectors(&run.particles().velocities).sum::<DVec3>();
    Ok(run.report(vec![Measure::zero("drift", "N·s", (impulse + water).length(), pushed).goal(1e-4)]))
}
