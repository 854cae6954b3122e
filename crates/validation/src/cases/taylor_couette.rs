//! Between two cylinders, of which the inner one turns, each feels a torque.

use crate::case::{Case, Parameter};
use crate::reference::taylor_couette_torque;
use crate::run::{Report, Run};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{BodySample, Shape};

/// Simulated time in gap²/ν, as between two plates.
const DURATION: f64 = 1.5;

pub(super) const CASE: Case = Case {
    name: "taylor-couette",
    about: "flow between a turning cylinder and one at rest round it: torque for a metre of length",
    source: "4πμΩ R₁²R₂²/(R₂² − R₁²), Landau & Lifshitz 1987, Fluid Mechanics, 2nd ed., §18, below the onset of vortices (Taylor 1923, doi:10.1098/rsta.1923.0008)",
    parameters: &[
        Parameter::number("inner", "m", "0.02", [0.001, 0.5], "Radius of the inner cylinder."),
        Parameter::number(
            "outer",
            "m",
            "0.04",
            [0.002, 1.0],
            "Radius of the outer cylinder, the larger one.",
        ),
        Parameter::number("omega", "rad/s", "5", [0.01, 1000.0], "Angular velocity of the inner cylinder."),
        Parameter::number("viscosity", "Pa·s", "1", [1e-3, 1e3], "Dynamic viscosity."),
    ],
    length: "inner",
    cells: [12.0, 14.0, 17.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (inner, outer, omega) = (setup.number("inner"), setup.number("outer"), setup.number("omega"));
    let gap = outer - inner;
    if gap < 4.0 * setup.dx {
        return Err(ValidationError::BadValue {
            case: CASE.name,
            name: "outer",
            value: outer.to_string(),
            expected: format!("at least four spacings more than inner, {} m", inner + 4.0 * setup.dx),
        });
    }
    let (mut world, length) = worlds::drum(outer, setup.dx);
    // A rod whose ends lie out of reach in the neighbouring periods.
    let rod = Shape::Disc { radius: inner, thickness: 3.0 * length };
    world.bodies.push(worlds::body(rod, DVec3::Y * 0.5 * length));
    let turning =
        BodySample { angular_velocity: DVec3::Y * omega, ..BodySample::at(world.bodies[1].position) };
    let mut run = Run::start(setup, setup.enclosed(world, omega * inner))?;
    let duration = DURATION * gap * gap / run.config().settings.kinematic_viscosity();
    let mut torque = Vec::new();
    while run.time() < duration {
        let output = run.step(Some(vec![BodySample::at(DVec3::ZERO), turning]));
        torque.push([run.time(), -output.loads[1].torque.y / length]);
    }
    let expected = taylor_couette_torque(inner, outer, omega, setup.number("viscosity"));
    let measured = stats::mean(stats::last(&torque, 0.25));
    Ok(run.report(vec![Measure::new("torque", "N", measured, expected).goal(0.05)]))
}
