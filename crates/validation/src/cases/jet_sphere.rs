//! A falling jet on a ball: what the ball feels is what the water loses, nothing to the side, and little changes as
//! the spacing shrinks.

use crate::case::{Case, Parameter};
use crate::control_volume::ControlVolume;
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, worlds};
use glam::DVec3;
use hapflow_fluid::{Aabb, Shape};

/// Simulated time, s.
const DURATION: f64 = 2.0;

pub(super) const CASE: Case = Case {
    name: "jet-sphere",
    about: "a falling jet on a ball: force against the balance of a box round it, side force, limit of the force",
    source: "balance of momentum over a control volume; symmetry; the limit is the line through all spacings at 0",
    parameters: &[
        Parameter::number("diameter", "m", "0.02", [0.002, 0.2], "Diameter of the jet."),
        Parameter::number(
            "speed",
            "m/s",
            "1.2",
            [0.1, 10.0],
            "Speed at the outlet, five diameters above the ball's top.",
        ),
        Parameter::number("radius", "m", "0.015", [0.002, 0.2], "Radius of the ball."),
        Parameter::number(
            "offset",
            "m",
            "0",
            [0.0, 0.2],
            "Distance of the jet's axis from the ball's centre.",
        ),
    ],
    length: "diameter",
    cells: [4.0, 6.0, 8.0],
    variants: &[&[("offset", "0")], &[("offset", "0.008")]],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (diameter, radius, offset) =
        (setup.number("diameter"), setup.number("radius"), setup.number("offset"));
    let outlet = radius + 3.0 * diameter;
    let wide = 4.0 * radius + 2.0 * diameter;
    let around = |low: f64, wide: f64, high: f64| Aabb {
        min: DVec3::new(-wide, -low, -wide),
        max: DVec3::new(wide, high, wide),
    };
    let mut world = worlds::empty(around(6.0 * radius, 2.0 * wide, outlet + diameter));
    world.sources = vec![worlds::jet(outlet, diameter, setup.number("speed"))];
    world.sources[0].position.x = offset;
    world.bodies = vec![worlds::body(Shape::Sphere { radius }, DVec3::ZERO)];
    let mut run = Run::start(setup, setup.config(world))?;
    let settings = &run.config().settings;
    // It begins below the length in which the source still leads the water, and well above the ball.
    let volume = around(3.0 * radius, wide, radius + 1.25 * diameter);
    let balance = ControlVolume { volume, mass: settings.particle_mass(), gravity: settings.gravity };
    let (mut load, mut impulse, mut time) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    let mut before = None;
    while run.time() < DURATION {
        let mut force = DVec3::ZERO;
        for _ in 0..run.steps_per_ms() {
            force += run.step(None).loads[0].force() * run.dt();
        }
        if run.time() > 0.75 * DURATION {
            let after = run.particles().clone();
            if let Some(before) = &before {
                load += force;
                impulse += balance.impulse(before, &after, 1e-3);
                time += 1e-3;
            }
            before = Some(after);
        }
    }
    let (force, lost) = (load / time, impulse / time);
    let axial = -force.y;
    let mut measures = vec![
        Measure::zero("residual", "N", (force - lost).length(), axial).goal(0.01),
        Measure::limit("axial_force", "N", axial).goal(0.10),
    ];
    if offset == 0.0 {
        measures.push(Measure::zero("side_force", "N", force.x.hypot(force.z), axial).goal(0.02));
    }
    Ok(run.report(measures))
}
