//! Between a wall at rest and one that slides, the velocity grows in a straight line.

use crate::case::{Case, Parameter};
use crate::reference::couette;
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{BodySample, ParticleView};

/// Reynolds number of gap and highest speed: a creeping flow.
const REYNOLDS: f64 = 2.0;
/// Simulated time in gap²/ν: the slowest mode decays with π² ν/gap², to e⁻¹⁵.
const DURATION: f64 = 1.5;

pub(super) const CASE: Case = Case {
    name: "couette",
    about: "flow between a wall at rest and one that slides: velocity profile",
    source: "u = U y/h, an exact solution of Navier and Stokes' equation",
    parameters: PARAMETERS,
    length: "gap",
    cells: [16.0, 20.0, 26.0],
    variants: &[],
    run,
};

/// Parameters of a flow between two plates.
pub(super) const PARAMETERS: &[Parameter] = &[
    Parameter::number(
        "gap",
        "m",
        "0.02",
        [0.001, 1.0],
        "Distance of the plates; they move for a Reynolds number of 2.",
    ),
    Parameter::number("viscosity", "Pa·s", "1", [1e-3, 1e3], "Dynamic viscosity."),
    Parameter::DENSITY,
];

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (gap, [speed, duration]) = (setup.number("gap"), scales(setup));
    let world = worlds::layer(gap, setup.dx);
    let (below, above) = (world.bodies[0].position, world.bodies[1].position);
    let mut run = Run::start(setup, setup.enclosed(world, speed))?;
    let mut errors = Vec::new();
    while run.time() < duration {
        let way = DVec3::X * speed * (run.time() + run.dt());
        let sliding = BodySample { velocity: DVec3::X * speed, ..BodySample::at(above + way) };
        run.step(Some(vec![BodySample::at(below), sliding]));
        if run.time() > 0.75 * duration {
            let time = run.time();
            errors.push([time, distance(run.particles(), |y| speed * couette(y / gap))]);
        }
    }
    let error = Measure::zero("velocity_l2", "1", stats::mean(&errors), 1.0);
    Ok(run.report(vec![error.goal(0.01).order_at_least(1.0)]))
}

/// Highest speed (m/s), and time to the steady state (s), of a flow between plates.
pub(super) fn scales(setup: &Setup<'_>) -> [f64; 2] {
    let (gap, viscosity) = (setup.number("gap"), setup.number("viscosity") / setup.number("density"));
    [REYNOLDS * viscosity / gap, DURATION * gap * gap / viscosity]
}

/// Distance of the velocities along x from the profile `exact` of y, over that profile's own size, in the mean square.
pub(super) fn distance(view: &ParticleView, exact: impl Fn(f64) -> f64) -> f64 {
    let (mut off, mut size) = (0.0, 0.0);
    for (x, v) in view.positions.iter().zip(&view.velocities) {
        let u = exact(f64::from(x[1]));
        off += (f64::from(v[0]) - u).powi(2);
        size += u * u;
    }
    (off / size).sqrt()
}
