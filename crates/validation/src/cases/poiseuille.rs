//! Between two walls at rest, a force along them drives a parabola.

use super::couette::{PARAMETERS, distance, scales};
use crate::case::Case;
use crate::reference::poiseuille;
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;

pub(super) const CASE: Case = Case {
    name: "poiseuille",
    about: "flow between two walls that an even force drives: velocity profile",
    source: "u = f y (h − y)/(2 μ), an exact solution of Navier and Stokes' equation",
    parameters: PARAMETERS,
    length: "gap",
    cells: [16.0, 20.0, 26.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (gap, [speed, duration]) = (setup.number("gap"), scales(setup));
    let mut config = setup.enclosed(worlds::layer(gap, setup.dx), speed);
    // The highest speed is 3/2 of the mean one.
    let mean = speed / 1.5;
    config.settings.gravity = DVec3::X * 12.0 * config.settings.kinematic_viscosity() * mean / (gap * gap);
    let mut run = Run::start(setup, config)?;
    let mut errors = Vec::new();
    while run.time() < duration {
        run.step(None);
        if run.time() > 0.75 * duration {
            let time = run.time();
            errors.push([time, distance(run.particles(), |y| mean * poiseuille(y / gap))]);
        }
    }
    let error = Measure::zero("velocity_l2", "1", stats::mean(&errors), 1.0);
    Ok(run.report(vec![error.goal(0.01).order_at_least(1.0)]))
}
