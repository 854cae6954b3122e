//! A jet that meets a wide plate at right angles pushes it with ρ A v² and with nothing to the side: the
//! particles at every spacing, speed and density tried, and the closed form exactly.

#[cfg(test)]
mod common;

use common::{Run, jet_scene};
use glam::DVec3;
use hapflow_fluid::{
    AnalyticJet, BodyDrive, BodyMotion, BodySample, FluidBackend, FluidConfig, FrameInput, Shape, Solver,
};
use std::f64::consts::PI;

const RADIUS: f64 = 0.01;

/// A jet without gravity on a disc of `radii` jet radii.
fn scene(spacing: f64, speed: f64, density: f64, radii: f64) -> FluidConfig {
    let mut config = jet_scene(Solver::Wcsph, spacing);
    config.settings.gravity = DVec3::ZERO;
    config.settings.rest_density = density;
    config.world.bodies[0].shape = Shape::Disc { radius: radii * RADIUS, thickness: 0.01 };
    config.world.sources[0].position = DVec3::Y * 0.04;
    config.world.sources[0].speed = speed;
    config
}

fn expected(speed: f64, density: f64) -> f64 {
    density * PI * RADIUS * RADIUS * speed * speed
}

/// Mean force over `seconds` in the steady state, in units of ρ A v².
fn particles(spacing: f64, speed: f64, density: f64, radii: f64) -> DVec3 {
    let mut run = Run::new(&scene(spacing, speed, density, radii));
    // Four times the way from the outlet to the plate's rim.
    run.run(4.0 * (0.04 + radii * RADIUS) / speed);
    run.mean_force(0.36 / speed) / expected(speed, density)
}

#[test]
fn particles_push_with_rho_a_v_squared() {
    for (spacing, speed, density, radii) in [
        (0.005, 1.5, 1000.0, 3.0),
        (0.005, 3.0, 1000.0, 4.0),
        (0.0037, 1.5, 1000.0, 3.0),
        (0.005, 3.0, 870.0, 3.0),
    ] {
        let force = particles(spacing, speed, density, radii);
        let case = format!("dx {spacing} m, {speed} m/s, {density} kg/m³: {force}");
        assert!((force.y + 1.0).abs() < 0.15, "{case}");
        assert!(force.x.hypot(force.z) < 0.01, "{case}");
    }
}

#[test]
fn the_closed_form_is_exact() {
    for (speed, density) in [(1.5, 1000.0), (3.0, 1000.0), (1.5, 870.0)] {
        let config = scene(0.005, speed, density, 3.0);
        let mut jet = AnalyticJet::new(&config).unwrap();
        let path = [BodySample::at(DVec3::ZERO)];
        let bodies = [BodyMotion { drive: BodyDrive::Led, path: &path }];
        for _ in 0..3 {
            jet.submit(&FrameInput { duration: 1e-3, bodies: &bodies });
            let force = jet.poll().unwrap().loads[0].force() / expected(speed, density);
            assert!((force - DVec3::NEG_Y).length() < 1e-3, "{speed} m/s, {density} kg/m³: {force}");
        }
    }
}
