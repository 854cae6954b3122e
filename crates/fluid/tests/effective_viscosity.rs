//! The viscosity that the solver says it adds is the one that a wave of shear decays with.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{Run, vector};
use glam::DVec3;
use hapflow_fluid::{Aabb, FluidConfig, FluidSettings, World};
use std::f64::consts::{PI, TAU};

/// Side of the box, m.
const SIDE: f64 = 0.1;

/// A box that repeats on all sides, `cells` spacings wide and high.
fn filled(cells: u32, viscosity: f64, artificial_viscosity: f64, sound_speed: f64) -> FluidConfig {
    let spacing = SIDE / f64::from(cells);
    let size = DVec3::new(SIDE, SIDE, 9.0 * spacing);
    let bounds = Aabb { min: -0.5 * size, max: 0.5 * size };
    let world = World { bounds, periodic: [true; 3], pools: vec![bounds], ..World::default() };
    let settings = FluidSettings {
        spacing,
        viscosity,
        gravity: DVec3::ZERO,
        artificial_viscosity,
        sound_speed,
        background_pressure: 20.0,
        ..FluidSettings::default()
    };
    FluidConfig { settings, world, frame_hz: 200.0, threads: 1 }
}

/// Amplitude of the wave along x that goes up and down along y, m/s.
fn amplitude(run: &mut Run, wave_number: f64) -> f64 {
    let view = run.snapshot();
    let rows = view.positions.iter().zip(&view.velocities);
    let sum: f64 = rows.map(|(x, v)| vector(v).x * (wave_number * vector(x).y).sin()).sum();
    2.0 * sum / view.positions.len() as f64
}

/// Viscosity (Pa·s) that `waves` in the box of this speed (m/s) decay with in a second, or while the fastest fluid goes ten
/// spacings.
fn measured(config: &FluidConfig, waves: f64, speed: f64) -> f64 {
    let wave_number = TAU * waves / SIDE;
    let mut run = Run::new(config);
    run.fluid.set_flow(|x| DVec3::X * (speed * (wave_number * x.y).sin()));
    let before = amplitude(&mut run, wave_number);
    let frames = ((10.0 * config.settings.spacing / speed).min(1.0) * config.frame_hz).round();
    for _ in 0..frames as u32 {
        run.frame();
    }
    let rate = (before / amplitude(&mut run, wave_number)).ln() * config.frame_hz / frames;
    config.settings.rest_density * rate / (wave_number * wave_number)
}

/// Share of the filter that a wave of this amplitude and wave number wakes, where it is nowhere all of it.
fn share(config: &FluidConfig, wave_number: f64, speed: f64) -> f64 {
    let s = &config.settings;
    let bend = (wave_number * s.support_length()).powi(2) * speed;
    // Weighted with the energy that is lost, sin² of the height, the mean of |sin| is 8/(3π).
    0.1 + 8.0 / (3.0 * PI) * bend / (s.artificial_viscosity * config.sound_speed())
}

/// A weak filter and a fast flow, which wakes all of it; a strong one and a slow flow, which feels little more than a tenth.
#[test]
fn waves_of_shear_decay_by_the_stated_viscosity_and_the_reported_one() {
    let fast = [2.0, 3.0].map(|waves| (0.05, 1.0, 0.1, waves));
    for (artificial, sound, speed, waves) in fast.into_iter().chain([(0.1, 4.0, 0.01, 2.0)]) {
        for (cells, stated) in [(20, 0.0), (20, 0.02), (25, 0.02)] {
            let config = filled(cells, stated, artificial, sound);
            let share = share(&config, TAU * waves / SIDE, speed).min(1.0);
            let added = share * config.added_viscosity(SIDE / waves);
            let all = measured(&config, waves, speed);
            println!("{cells} cells, {waves} waves: {stated} + {added:.5} Pa·s, measured {all:.5}");
            assert!((all / (stated + added) - 1.0).abs() < 0.15, "{stated} + {added}, but {all}");
        }
    }
}
