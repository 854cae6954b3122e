//! A world that repeats: nothing is lost or felt at its sides.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{Run, aabb, kinetic_energy, momentum, vector};
use glam::DVec3;
use hapflow_fluid::{Aabb, BodyConfig, BodyDrive, BodySample, FluidConfig, FluidSettings, Shape, World};

/// A fluid that fills a cube of `side` that repeats on all sides, without gravity.
fn filled(side: f64, cells: u32, shift: DVec3) -> FluidConfig {
    let bounds = Aabb { min: shift - 0.5 * side, max: shift + 0.5 * side };
    let world = World { bounds, periodic: [true; 3], pools: vec![bounds], ..World::default() };
    let settings = FluidSettings {
        spacing: side / f64::from(cells),
        gravity: DVec3::ZERO,
        sound_speed: 2.0,
        background_pressure: 50.0,
        ..FluidSettings::default()
    };
    FluidConfig { settings, world, frame_hz: 500.0, threads: 1 }
}

#[test]
fn a_uniform_stream_goes_round_and_nothing_changes() {
    for velocity in [DVec3::new(0.4, 0.0, 0.0), DVec3::new(-0.3, 0.2, 0.5)] {
        let config = filled(0.1, 10, DVec3::ZERO);
        let mut run = Run::new(&config);
        run.fluid.set_flow(|_| velocity);
        let before = run.snapshot();
        let mass = config.settings.particle_mass();
        let output = run.run(0.5);
        let after = run.snapshot();
        assert_eq!(output.particles, 1000);
        let (start, end) = (momentum(&before, mass), momentum(&after, mass));
        assert!((end - start).length() < 1e-4 * start.length(), "{start} {end}");
        assert!((kinetic_energy(&after, mass) / kinetic_energy(&before, mass) - 1.0).abs() < 1e-3);
        assert!(after.positions.iter().all(|p| vector(p).abs().max_element() <= 0.05 + 1e-6));
    }
}

/// Where the sides stand is of no account: the same fluid cut elsewhere has the same energy later on.
#[test]
fn the_place_of_the_sides_is_not_felt() {
    let side = 0.1;
    let k = std::f64::consts::TAU / side;
    let flow = |p: DVec3| {
        0.1 * DVec3::new((k * p.x).sin() * (k * p.y).cos(), -(k * p.x).cos() * (k * p.y).sin(), 0.0)
    };
    let energies: Vec<f64> = [DVec3::ZERO, DVec3::new(0.03, -0.02, 0.05)]
        .into_iter()
        .map(|shift| {
            let mut config = filled(side, 12, shift);
            config.settings.viscosity = 1.0;
            let mut run = Run::new(&config);
            run.fluid.set_flow(flow);
            run.run(0.1);
            kinetic_energy(&run.snapshot(), config.settings.particle_mass())
        })
        .collect();
    assert!((energies[0] / energies[1] - 1.0).abs() < 0.01, "{energies:?}");
}

/// A ball that is led across a side feels what it feels anywhere.
#[test]
fn a_body_crosses_a_side() {
    let mut config = filled(0.1, 10, DVec3::ZERO);
    let shape = Shape::Sphere { radius: 0.02 };
    config.settings.viscosity = 2.0;
    config.world.bodies = vec![BodyConfig { shape, ..BodyConfig::default() }];
    let mut run = Run::new(&config);
    let (speed, dt) = (0.1, 1.0 / config.frame_hz);
    let mut forces = Vec::new();
    for k in 0..600 {
        let at = |k: i32| BodySample {
            velocity: DVec3::X * speed,
            ..BodySample::at(DVec3::X * (speed * dt * f64::from(k)))
        };
        let path = [at(k), BodySample { time: dt, ..at(k + 1) }];
        let output = run.frame_with(BodyDrive::Led, &path);
        forces.push(output.loads[0].force().x);
    }
    // The ball crosses at 0.05 m, in frame 250. It carries the fluid along, so the drag falls all the while, evenly.
    let mean = |from: usize| forces[from..from + 60].iter().sum::<f64>() / 60.0;
    let (before, across, after) = (mean(150), mean(220), mean(290));
    assert!(before < 0.0 && after < 0.0);
    assert!((across / -(before * after).sqrt() - 1.0).abs() < 0.03, "{before} {across} {after}");
}

#[test]
fn a_period_that_is_too_short_is_refused() {
    let mut config = filled(0.1, 10, DVec3::ZERO);
    config.world.bounds = aabb([-0.01, -0.05, -0.05], [0.01, 0.05, 0.05]);
    let error = hapflow_fluid::CpuBackend::new(&config).unwrap_err().to_string();
    assert!(error.contains("bounds (period)"), "{error}");
}
