//! Mode Mixed leaves every other sub-step without interaction, and the mean forces stay what the momentum demands:
//! ρ A v² under a jet, Archimedes' force in a tank.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, ball_volume, jet_scene, tank_scene};
use glam::DVec3;
use hapflow_fluid::{InteractionMode, Shape, Solver};
use std::f64::consts::PI;

#[test]
fn a_jet_on_a_disc_pushes_with_rho_a_v_squared() {
    for solver in SOLVERS {
        for spacing in [0.005, 0.0042] {
            let mut config = jet_scene(solver, spacing);
            config.settings.mode = InteractionMode::Mixed;
            config.settings.gravity = DVec3::ZERO;
            config.world.bodies[0].shape = Shape::Disc { radius: 0.03, thickness: 0.01 };
            let mut run = Run::new(&config);
            run.run(0.2);
            let force = run.mean_force(0.2) / (1000.0 * PI * 1e-4 * 1.5 * 1.5);
            assert!(
                (force - DVec3::NEG_Y).length() < 0.15,
                "{solver:?}, dx {spacing} m: {force} of rho A v^2"
            );
        }
    }
}

#[test]
fn a_ball_in_a_tank_is_carried_and_not_shaken() {
    for cells in [12, 14] {
        let mut config = tank_scene(Solver::Wcsph, 0.2, cells, 0.05);
        config.settings.mode = InteractionMode::Mixed;
        let mut run = Run::new(&config);
        run.run(0.5);
        let archimedes = 1000.0 * 9.81 * ball_volume(0.05);
        let forces: Vec<_> = (0..50).map(|_| run.frame().loads[0].force() / archimedes).collect();
        let mean = forces.iter().sum::<DVec3>() / forces.len() as f64;
        let scatter = forces.iter().map(|f| (*f - mean).length_squared()).sum::<f64>() / forces.len() as f64;
        assert!((mean - DVec3::Y).length() < 0.05, "{cells} cells: {mean} of Archimedes' force");
        assert!(scatter.sqrt() < 0.1, "{cells} cells: scatter {}", scatter.sqrt());
    }
}
