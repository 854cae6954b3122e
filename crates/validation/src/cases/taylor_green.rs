//! A lattice of vortices decays by viscosity alone.

use crate::case::{Case, Parameter};
use crate::reference::taylor_green_rate;
use crate::run::{Report, Run, vectors};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use std::f64::consts::TAU;

/// Highest speed at the start, m/s.
const SPEED: f64 = 0.1;
/// Share of the run in which the pressure finds its field, and that is left out.
const START: f64 = 0.1;
/// Thickness after which the flow repeats, in spacings.
const THICKNESS: f64 = 9.0;

pub(super) const CASE: Case = Case {
    name: "taylor-green",
    about: "a periodic lattice of vortices: rate at which its speeds decay",
    source: "8π²ν/L², an exact solution of Navier and Stokes' equation (Taylor & Green 1937, doi:10.1098/rspa.1937.0036)",
    parameters: &[
        Parameter::number("length", "m", "0.1", [0.005, 1.0], "Length of the period L."),
        Parameter::number("re", "", "100", [1.0, 1000.0], "Reynolds number U L/ν; it sets the viscosity."),
    ],
    length: "length",
    cells: [32.0, 40.0, 50.0],
    variants: &[&[("re", "100")], &[("re", "10")]],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let length = setup.number("length");
    let viscosity = SPEED * length / setup.number("re");
    let all = worlds::upright(DVec3::new(length, length, THICKNESS * setup.dx));
    let mut world = worlds::empty(all);
    world.periodic = [true; 3];
    world.pools = vec![all];
    let mut config = setup.enclosed(world, SPEED);
    config.settings.viscosity = viscosity * config.settings.rest_density;
    let mut run = Run::start(setup, config)?;
    run.set_flow(|x| {
        let (a, b) = (TAU * x.x / length, TAU * x.y / length);
        SPEED * DVec3::new(a.sin() * b.cos(), -a.cos() * b.sin(), 0.0)
    });
    let expected = taylor_green_rate(length, viscosity);
    let mut energy = Vec::new();
    while run.time() * expected < 1.0 {
        run.step(None);
        let time = run.time();
        energy.push([time, vectors(&run.particles().velocities).map(|v| v.length_squared()).sum()]);
    }
    // Energy is the square of the speeds.
    let measured = 0.5 * stats::decay_rate(stats::last(&energy, 1.0 - START));
    Ok(run.report(vec![Measure::new("decay_rate", "1/s", measured, expected).goal(0.03)]))
}
