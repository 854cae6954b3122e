//! A ball that is let go in a tube rises or sinks with the speed at which its drag is its net weight.

use crate::case::{Case, Parameter};
use crate::reference::{GRAVITY, SphereInTube, ball_volume};
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{Shape, World};

/// Diameter of the tube, way of the ball, and room beyond the way's ends, in diameters of the ball.
const TUBE: f64 = 5.0;
const WAY: f64 = 2.0;
const ROOM: f64 = 1.25;
/// Time at rest before the ball is let go, s.
const REST: f64 = 0.2;

pub(super) const CASE: Case = Case {
    name: "terminal-velocity",
    about: "a ball let go in a tube of five diameters, lighter or heavier than the fluid: its speed",
    source: "drag of drag-sphere = |ρ_b − ρ| g V",
    parameters: &[
        Parameter::number("radius", "m", "0.02", [0.001, 0.2], "Radius of the ball."),
        Parameter::number(
            "body_density",
            "kg/m³",
            "2000",
            [50.0, 20_000.0],
            "Density of the ball, unlike the fluid's 1000.",
        ),
        Parameter::number("viscosity", "Pa·s", "2", [1e-3, 1e3], "Dynamic viscosity of the fluid."),
    ],
    length: "radius",
    cells: [3.0, 3.5, 4.0],
    variants: &[&[("body_density", "2000")], &[("body_density", "500")]],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (radius, body_density) = (setup.number("radius"), setup.number("body_density"));
    let (diameter, volume) = (2.0 * radius, ball_volume(radius));
    let mut config = setup.config(tube(radius));
    let density = config.settings.rest_density;
    let ball = SphereInTube { radius, blockage: 1.0 / TUBE, density, viscosity: config.settings.viscosity };
    let weight = (body_density - density) * GRAVITY * volume;
    let expected = ball.terminal_speed(weight.abs());
    if expected == 0.0 || !expected.is_finite() {
        let expected = format!("other than the fluid's {density} kg/m³");
        let value = body_density.to_string();
        return Err(ValidationError::BadValue { case: CASE.name, name: "body_density", value, expected });
    }
    let start = if weight > 0.0 { ROOM + WAY } else { ROOM } * diameter;
    config.world.bodies[0].position = DVec3::Y * start;
    config.world.bodies[0].mass = body_density * volume;
    let mut run = Run::start(setup, config)?;
    while run.time() < REST {
        run.step(None);
    }
    let mut speed = Vec::new();
    // Time enough for the way at the expected speed; a ball that is too fast ends with the way.
    let mut gone = 0.0;
    while gone < WAY * diameter && (run.time() - REST) * expected < WAY * diameter {
        let ball = run.step_free().bodies[0];
        gone = (ball.position.y - start).abs();
        speed.push([run.time(), ball.velocity.y.abs()]);
    }
    let measured = stats::mean(stats::last(&speed, 0.25));
    Ok(run.report(vec![Measure::new("speed", "m/s", measured, expected).goal(0.10)]))
}

/// A tube on the ground, filled but for its top.
fn tube(radius: f64) -> World {
    let diameter = 2.0 * radius;
    let length = (WAY + 2.0 * ROOM) * diameter;
    let water = worlds::upright(DVec3::new(TUBE * diameter, length, TUBE * diameter));
    let mut world = worlds::empty(water);
    (world.bounds.min, world.bounds.max) = (water.min - diameter, water.max + diameter);
    world.ground = Some(0.0);
    world.pools = vec![water];
    world.bodies = vec![
        worlds::body(Shape::Sphere { radius }, DVec3::ZERO),
        worlds::body(Shape::Drum { radius: 0.5 * TUBE * diameter }, DVec3::ZERO),
    ];
    world
}
