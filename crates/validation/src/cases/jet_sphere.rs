//! A falling jet on a ball: what the ball feels is what the water loses, nothing to the side, and little changes as
//! the spacing shrinks.

use crate::case::{Case, Parameter};
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, worlds};
use glam::DVec3;
use hapflow_fluid::{Aabb, ControlVolume, Shape};

/// Simulated time, s.
const DURATION: f64 = 2.0;

pub(super) const CASE: Case = Case {
    name: "jet-sphere",
    about: "a falling jet on a ball: force against the balance of a box round it, side force, limit of the force",
    source: "balance of momentum over a control volume; symmetry; Richardson's extrapolation to spacing 0",
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
    let mut world = worlds::empty(around(6.0 * radius, 2.0 * wide, outlet + diameter));
    world.sources = vec![worlds::jet(outlet, diameter, setup.number("speed"))];
    world.sources[0].position.x = offset;
    world.bodies = vec![worlds::body(Shape::Sphere { radius }, DVec3::ZERO)];
    let mut run = Run::start(setup, setup.config(world))?;
    // It begins below the length in which the source still leads the water, and well above the ball.
    let [force, lost] = forces(&mut run, around(3.0 * radius, wide, radius + 1.25 * diameter));
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

/// A box round the ball, from `low` below it to `high` above, and as `wide` on each side, m.
fn around(low: f64, wide: f64, high: f64) -> Aabb {
    Aabb { min: DVec3::new(-wide, -low, -wide), max: DVec3::new(wide, high, wide) }
}

/// Force on the ball, and momentum that the water in `volume` loses to it for a second, N: means over the last quarter.
fn forces(run: &mut Run, volume: Aabb) -> [DVec3; 2] {
    let settings = &run.config().settings;
    let balance = ControlVolume { volume, mass: settings.particle_mass(), gravity: settings.gravity };
    while run.time() < 0.75 * DURATION {
        run.step(None);
    }
    let (start, mut before) = (run.time(), run.particles().clone());
    let (mut load, mut lost) = (DVec3::ZERO, DVec3::ZERO);
    while run.time() < DURATION {
        for _ in 0..run.steps_per_ms() {
            load += run.step(None).loads[0].force() * run.dt();
        }
        let after = run.particles().clone();
        lost += balance.impulse(&before, &after, 1e-3);
        before = after;
    }
    let time = run.time() - start;
    [load / time, lost / time]
}
