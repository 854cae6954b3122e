//! A ball that moves along a closed tube is held back by the fluid.

use crate::case::{Case, Parameter};
use crate::reference::SphereInTube;
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{BodySample, Shape};

/// Diameter of the tube, and room between the ball's way and the tube's ends, in diameters of the ball.
const TUBE: f64 = 5.0;
const ROOM: f64 = 2.0;
/// Speed of the ball, m/s; only the Reynolds number matters.
const SPEED: f64 = 0.1;

pub(super) const CASE: Case = Case {
    name: "drag-sphere",
    about: "a ball moved along a closed tube of five diameters: drag",
    source: "Schiller & Naumann 1933 (Z. Ver. Dtsch. Ing. 77, 318), slowed by the tube as Di Felice 1996 (Int. J. Multiphase Flow 22(3), 527) says",
    parameters: &[
        Parameter::number("radius", "m", "0.01", [0.001, 0.2], "Radius of the ball."),
        Parameter::number(
            "re",
            "",
            "10",
            [0.1, 300.0],
            "Reynolds number of the diameter; it sets the viscosity.",
        ),
        Parameter::DENSITY,
    ],
    length: "radius",
    cells: [4.0, 4.4, 4.8],
    variants: &[&[("re", "10")], &[("re", "1")], &[("re", "100")]],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (radius, re, density) = (setup.number("radius"), setup.number("re"), setup.number("density"));
    let diameter = 2.0 * radius;
    // The flow of a ball set off from rest is steady after a diameter or two if it creeps, and later else.
    let way = diameter * if re < 3.0 { 2.0 } else { 4.0 };
    let length = way + 2.0 * ROOM * diameter;
    let inside = worlds::upright(DVec3::new(TUBE * diameter, length, TUBE * diameter));
    let mut world = worlds::empty(inside);
    (world.bounds.min, world.bounds.max) = (inside.min - diameter, inside.max + diameter);
    world.pools = vec![inside];
    let cap = |y: f64| worlds::body(Shape::Slab { thickness: 2.0 * diameter }, DVec3::Y * y);
    let start = DVec3::Y * ROOM * diameter;
    world.bodies = vec![
        worlds::body(Shape::Sphere { radius }, start),
        worlds::body(Shape::Drum { radius: 0.5 * TUBE * diameter }, DVec3::ZERO),
        cap(-diameter),
        cap(length + diameter),
    ];
    let still: Vec<_> = world.bodies[1..].iter().map(|b| BodySample::at(b.position)).collect();
    let viscosity = density * SPEED * diameter / re;
    let mut config = setup.enclosed(world, SPEED);
    config.settings.viscosity = viscosity;
    let mut run = Run::start(setup, config)?;
    let mut drag = Vec::new();
    while run.time() * SPEED < way {
        let place = start + DVec3::Y * SPEED * (run.time() + run.dt());
        let ball = BodySample { velocity: DVec3::Y * SPEED, ..BodySample::at(place) };
        let output = run.step(Some([&[ball][..], &still].concat()));
        drag.push([run.time(), -output.loads[0].force().y]);
    }
    let ball = SphereInTube { radius, blockage: 1.0 / TUBE, density, viscosity };
    let measured = stats::mean(stats::last(&drag, 0.25));
    let goal = if re > 30.0 { 0.20 } else { 0.10 };
    Ok(run.report(vec![Measure::new("drag", "N", measured, ball.drag(SPEED)).goal(goal)]))
}
