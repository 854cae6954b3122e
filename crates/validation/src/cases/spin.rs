//! Water that a drum has spun up has the spin that the drum gave it, and loses it when the drum stops.

use crate::case::{Case, Parameter};
use crate::reference::swirl_decay_rate;
use crate::run::{Report, Run, vectors};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{BodySample, ParticleView};

/// Time of spinning up, and times between which the decay is looked at, in decay times of the slowest mode: the next
/// mode decays more than three times as fast.
const SPIN_UP: f64 = 2.0;
const DECAY: [f64; 2] = [1.0, 3.0];

pub(super) const CASE: Case = Case {
    name: "spin",
    about: "water in a drum that turns and stops: rate of the slowest swirl's decay; spin against the drum's torque",
    source: "ν (j₁₁/R)² with j₁₁ = 3.8317, the slowest mode of ∂u/∂t = ν (u″ + u′/r − u/r²); balance of angular momentum",
    parameters: &[
        Parameter::number("radius", "m", "0.05", [0.005, 0.5], "Radius of the drum."),
        Parameter::number("omega", "rad/s", "4", [0.01, 100.0], "Angular velocity of the drum."),
        Parameter::number(
            "viscosity",
            "Pa·s",
            "1",
            [1.0, 1e3],
            "Dynamic viscosity, of a fluid of 1000 kg/m³.",
        ),
    ],
    length: "radius",
    cells: [14.0, 18.0, 24.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (radius, omega) = (setup.number("radius"), setup.number("omega"));
    let (world, _) = worlds::drum(radius, setup.dx);
    let mut run = Run::start(setup, setup.enclosed(world, omega * radius))?;
    let rate = swirl_decay_rate(radius, run.config().settings.kinematic_viscosity());
    let drum =
        |omega: f64| vec![BodySample { angular_velocity: DVec3::Y * omega, ..BodySample::at(DVec3::ZERO) }];
    let mut given = 0.0;
    while run.time() * rate < SPIN_UP {
        given -= run.step(Some(drum(omega))).loads[0].torque.y * run.dt();
    }
    let mass = run.config().settings.particle_mass();
    let [inertia, momentum] = spin(run.particles()).map(|s| s * mass);
    let (stop, mut swirl) = (run.time(), Vec::new());
    while (run.time() - stop) * rate < DECAY[1] {
        run.step(Some(drum(0.0)));
        let time = run.time();
        if (time - stop) * rate > DECAY[0] {
            swirl.push([time, spin(run.particles())[1]]);
        }
    }
    Ok(run.report(vec![
        Measure::new("decay_rate", "1/s", stats::decay_rate(&swirl), rate).goal(0.10),
        Measure::new("spin_rate", "rad/s", momentum / inertia, given / inertia).goal(0.10),
    ]))
}

/// Moment of inertia and angular momentum round the y axis, of particles of unit mass.
fn spin(view: &ParticleView) -> [f64; 2] {
    let rows = vectors(&view.positions).zip(vectors(&view.velocities));
    rows.fold([0.0; 2], |[inertia, momentum], (x, v)| {
        [inertia + x.x * x.x + x.z * x.z, momentum + x.z * v.x - x.x * v.z]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rigid_turn_has_its_angular_velocity() {
        let turn = |x: DVec3| (DVec3::Y * 3.0).cross(x).as_vec3().to_array();
        let places = [DVec3::new(0.1, 0.0, 0.0), DVec3::new(-0.02, 0.3, 0.05)];
        let view = ParticleView {
            positions: places.iter().map(|p| p.as_vec3().to_array()).collect(),
            velocities: places.iter().map(|p| turn(*p)).collect(),
            ..ParticleView::default()
        };
        let [inertia, momentum] = spin(&view);
        assert!((momentum / inertia - 3.0).abs() < 1e-6);
    }
}
