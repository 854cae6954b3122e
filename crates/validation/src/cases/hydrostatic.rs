//! Water at rest: its pressure grows with depth, and the floor carries its weight.

use crate::case::{Case, Parameter};
use crate::reference::GRAVITY;
use crate::run::{Report, Run, vectors};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{ParticleView, Shape};

/// Simulated time: the column's bounce decays in it, s.
const DURATION: f64 = 3.0;

pub(super) const CASE: Case = Case {
    name: "hydrostatic",
    about: "a layer of water, at first without pressure: pressure at its floor, and force on the floor",
    source: "p = ρ g h; weight ρ g A h",
    parameters: &[
        Parameter::number(
            "depth",
            "m",
            "0.2",
            [0.01, 2.0],
            "Depth of the water; it repeats after half as much.",
        ),
        Parameter::DENSITY,
    ],
    length: "depth",
    cells: [20.0, 25.0, 30.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    // Whole layers of particles: a broken one would make the water shallower or deeper than it is said to be.
    let whole = |length: f64| (length / setup.dx).round().max(1.0) * setup.dx;
    let (depth, density) = (whole(setup.number("depth")), setup.number("density"));
    let width = whole(0.5 * depth);
    // Without side walls: one would carry the water next to it, as far as the kernel reaches.
    let mut world = worlds::empty(worlds::upright(DVec3::new(width, 2.0 * depth, width)));
    world.periodic = [true, false, true];
    world.pools = vec![worlds::upright(DVec3::new(width, depth, width))];
    world.bodies = vec![worlds::body(Shape::Slab { thickness: depth }, DVec3::NEG_Y * 0.5 * depth)];
    world.bounds.min.y = -depth;
    let mut run = Run::start_without_pressure(setup, setup.config(world))?;
    let (steps, dt) = ((DURATION / run.dt()).ceil() as usize, run.dt());
    let (mut pressure, mut force) = (Vec::new(), Vec::new());
    for k in 0..steps {
        let output = run.step(None);
        let time = k as f64 * dt;
        if time >= 0.75 * DURATION {
            force.push([time, -output.loads[0].force().y]);
            if k.is_multiple_of(run.steps_per_ms()) {
                pressure.push([time, floor_pressure(run.particles(), setup.dx)]);
            }
        }
    }
    let weight = density * GRAVITY * width * width * depth;
    Ok(run.report(vec![
        Measure::new("pressure", "Pa", stats::mean(&pressure), density * GRAVITY * depth).goal(0.01),
        Measure::new("floor_force", "N", stats::mean(&force), weight).goal(0.01),
    ]))
}

/// Pressure at y = 0, from the straight line through that of the particles in the lowest four layers.
fn floor_pressure(view: &ParticleView, dx: f64) -> f64 {
    let rows = vectors(&view.positions).zip(&view.pressures);
    let low: Vec<_> = rows.filter(|(x, _)| x.y < 4.0 * dx).map(|(x, p)| [x.y, f64::from(*p)]).collect();
    stats::line(&low)[0]
}
