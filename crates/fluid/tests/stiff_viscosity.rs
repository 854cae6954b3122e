//! Viscosity that is solved for, where explicit steps would be far shorter than sound asks for.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{Run, aabb, body, momentum, vector};
use glam::DVec3;
use hapflow_fluid::{
    Aabb, BodyDrive, BodySample, Container, FluidConfig, FluidSettings, Shape, World, step_limits,
};
use std::f64::consts::TAU;

/// Side of the box, m.
const SIDE: f64 = 0.1;

/// A box that repeats on all sides; with the speed of sound (m/s) comes the step.
fn filled(viscosity: f64, sound_speed: f64) -> FluidConfig {
    let spacing = SIDE / 16.0;
    let size = DVec3::new(SIDE, SIDE, 9.0 * spacing);
    let bounds = Aabb { min: -0.5 * size, max: 0.5 * size };
    let world = World { bounds, periodic: [true; 3], pools: vec![bounds], ..World::default() };
    let settings = FluidSettings {
        spacing,
        viscosity,
        gravity: DVec3::ZERO,
        artificial_viscosity: 0.0,
        sound_speed,
        background_pressure: 20.0 * sound_speed * sound_speed,
        ..FluidSettings::default()
    };
    FluidConfig { settings, world, frame_hz: 1000.0, threads: 1 }
}

/// Rate at which a wave of shear decays, over the known one; and the sub-steps that it took.
fn decay(config: &FluidConfig, frames: u32) -> (f64, usize) {
    let wave_number = TAU / SIDE;
    let amplitude = |run: &mut Run| {
        let view = run.snapshot();
        let rows = view.positions.iter().zip(&view.velocities);
        rows.map(|(x, v)| vector(v).x * (wave_number * vector(x).y).sin()).sum::<f64>()
    };
    let mut run = Run::new(config);
    run.fluid.set_flow(|x| DVec3::X * (0.05 * (wave_number * x.y).sin()));
    let before = amplitude(&mut run);
    let steps = (0..frames).map(|_| run.frame().substeps).sum();
    let rate = (before / amplitude(&mut run)).ln() * config.frame_hz / f64::from(frames);
    (rate / (config.settings.kinematic_viscosity() * wave_number * wave_number), steps)
}

/// At one viscosity, by two speeds of sound: explicit and implicit give the same, and the implicit one in fewer steps.
#[test]
fn a_wave_decays_as_with_explicit_steps() {
    let (explicit, implicit) = (filled(10.0, 4.0), filled(10.0, 1.0));
    assert!(step_limits(&explicit, 0.05).viscous < 1e-3 && step_limits(&implicit, 0.05).viscous > 1.0);
    let (known, many) = decay(&explicit, 10);
    let (found, few) = decay(&implicit, 10);
    println!("explicit {known:.4} in {many} steps, implicit {found:.4} in {few}");
    assert!((known - 1.0).abs() < 0.03 && (found / known - 1.0).abs() < 0.04, "{known} {found}");
    assert!(3 * few <= many, "{few} {many}");
}

/// The steps are of first order in time: in one of length dt a wave of the rate s falls to 1/(1 + s dt).
#[test]
fn a_stiff_wave_decays_as_backward_euler_has_it() {
    let config = filled(100.0, 1.0);
    let (found, steps) = decay(&config, 5);
    let step =
        5.0 / config.frame_hz / steps as f64 * config.settings.kinematic_viscosity() * (TAU / SIDE).powi(2);
    let expected = step.ln_1p() / step;
    println!("{found:.4} of the known rate, backward Euler {expected:.4} at {step:.2}");
    assert!((found / expected - 1.0).abs() < 0.03, "{found} {expected}");
}

/// What a fluid as stiff as cold honey loses, the ball in it gets.
#[test]
fn a_ball_that_is_dragged_gets_all_that_the_fluid_loses() {
    let half = 0.04;
    let cube = aabb([-half; 3], [half; 3]);
    let world = World {
        bounds: aabb([-4.0 * half; 3], [4.0 * half; 3]),
        pools: vec![cube],
        bodies: vec![body(Shape::Sphere { radius: 0.015 }, DVec3::ZERO)],
        ..World::default()
    };
    let settings = FluidSettings {
        spacing: half / 6.0,
        viscosity: 300.0,
        gravity: DVec3::ZERO,
        sound_speed: 3.0,
        ..FluidSettings::default()
    };
    let config = FluidConfig { settings, world, frame_hz: 200.0, threads: 1 };
    let mut run = Run::new(&config);
    let (speed, dt) = (0.05, 1.0 / config.frame_hz);
    let (mut impulse, mut size, mut viscous) = (DVec3::ZERO, 0.0, 0.0);
    let before = momentum(&run.snapshot(), config.settings.particle_mass());
    for k in 0..20 {
        let at = |k: i32| BodySample {
            velocity: DVec3::X * speed,
            ..BodySample::at(DVec3::X * (speed * dt * f64::from(k)))
        };
        let path = [at(k), BodySample { time: dt, ..at(k + 1) }];
        let load = run.frame_with(BodyDrive::Led, &path).loads[0];
        impulse += load.force() * dt;
        size += load.force().length() * dt;
        viscous += load.viscous_force.length() * dt;
    }
    let gained = momentum(&run.snapshot(), config.settings.particle_mass()) - before;
    println!("fluid {gained}, ball {impulse}, of {size}, viscous {viscous}");
    assert!(viscous > 0.1 * size && (gained + impulse).length() < 1e-4 * size, "{gained} {impulse}");
}

/// A pool of honey at 1000 Pa·s lies on its floor and weighs what it weighs.
#[test]
fn a_stiff_pool_rests_on_its_floor() {
    let inner = aabb([-0.04, 0.0, -0.04], [0.04, 0.16, 0.04]);
    let world = World {
        bounds: aabb([-0.2; 3], [0.2; 3]),
        container: Some(Container::open_box(inner)),
        pools: vec![aabb([-0.04, 0.0, -0.04], [0.04, 0.08, 0.04])],
        ..World::default()
    };
    let settings = FluidSettings { spacing: 0.008, viscosity: 1000.0, ..FluidSettings::default() };
    let config = FluidConfig { settings, world, frame_hz: 100.0, threads: 1 };
    let mut run = Run::new(&config);
    let output = run.run(0.3);
    assert!(!output.degraded && output.max_speed < 0.05, "{output:?}");
    assert!(run.snapshot().positions.iter().all(|x| x[1] > 0.0));
}
