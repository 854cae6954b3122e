//! A drop without weight: the pressure in it, how it swings, and what a ball feels that it touches.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{Run, body, momentum, vector};
use glam::DVec3;
use hapflow_fluid::{Aabb, FluidConfig, FluidSettings, ParticleView, Shape, World};
use std::f64::consts::PI;

/// Surface tension, N/m.
const TENSION: f64 = 0.07;
/// Density, kg/m³.
const DENSITY: f64 = 1000.0;

/// A cube of fluid with the volume of a ball of `radius`, `cells` spacings wide: surface tension makes it a ball.
fn cube(radius: f64, cells: f64, viscosity: f64) -> FluidConfig {
    let side = radius * (4.0 / 3.0 * PI).cbrt();
    let half = DVec3::splat(0.5 * side);
    let bounds = Aabb { min: -4.0 * half, max: 4.0 * half };
    let world = World { bounds, pools: vec![Aabb { min: -half, max: half }], ..World::default() };
    let settings = FluidSettings {
        spacing: side / cells,
        gravity: DVec3::ZERO,
        rest_density: DENSITY,
        surface_tension: TENSION,
        viscosity,
        ..FluidSettings::default()
    };
    FluidConfig { settings, world, frame_hz: 500.0, threads: 1 }
}

/// Time scale of a drop, s.
fn scale(radius: f64) -> f64 {
    (DENSITY * radius.powi(3) / TENSION).sqrt()
}

/// Mean pressure of what is nearer to the middle than half of `radius`, Pa.
fn inner_pressure(view: &ParticleView, radius: f64) -> f64 {
    let centre = view.positions.iter().map(vector).sum::<DVec3>() / view.positions.len() as f64;
    let rows = view.positions.iter().zip(&view.pressures);
    let inner: Vec<f64> =
        rows.filter(|(x, _)| vector(x).distance(centre) < 0.5 * radius).map(|(_, p)| f64::from(*p)).collect();
    inner.iter().sum::<f64>() / inner.len() as f64
}

#[test]
fn the_pressure_in_a_drop_is_that_of_young_and_laplace() {
    for radius in [0.005, 0.01] {
        for (cells, within) in [(12.0, 0.14), (16.0, 0.07)] {
            let mut run = Run::new(&cube(radius, cells, 0.1));
            let count = run.snapshot().ids.len();
            run.run(2.0 * scale(radius));
            let samples = 20;
            let mut pressure = 0.0;
            for _ in 0..samples {
                run.run(0.1 * scale(radius));
                pressure += inner_pressure(&run.snapshot(), radius) / f64::from(samples);
            }
            let jump = 2.0 * TENSION / radius;
            println!("R {radius} m, {cells} cells: {pressure:.2} Pa, known {jump:.2} Pa");
            assert!((pressure / jump - 1.0).abs() < within, "{pressure} {jump}");
            assert_eq!(run.snapshot().ids.len(), count, "nothing flies off");
        }
    }
}

/// How much longer than wide: ⟨z²⟩ − ⟨x² + y²⟩/2.
fn stretch(view: &ParticleView) -> f64 {
    let n = view.positions.len() as f64;
    let centre = view.positions.iter().map(vector).sum::<DVec3>() / n;
    let square = view.positions.iter().map(|x| (vector(x) - centre).powf(2.0)).sum::<DVec3>() / n;
    square.z - 0.5 * (square.x + square.y)
}

/// Rayleigh 1879: ω² = 8σ/(ρ R³) for the slowest mode of a drop.
#[test]
fn a_drop_swings_with_rayleighs_frequency() {
    for cells in [12.0, 16.0] {
        let radius = 0.005;
        let mut config = cube(radius, cells, 0.1);
        let mut run = Run::new(&config);
        run.run(3.0 * scale(radius));
        config.settings.viscosity = 0.001;
        run.configure(&config);
        let rest = stretch(&run.snapshot());
        run.fluid.set_flow(|x| 6.0 * DVec3::new(-0.5 * x.x, -0.5 * x.y, x.z));
        let known = (8.0 * TENSION / (DENSITY * radius.powi(3))).sqrt();
        let (mut time, mut last) = (0.0, 0.0);
        let half_period = loop {
            run.frame();
            let (before, now) = (last, stretch(&run.snapshot()) - rest);
            time += 1.0 / config.frame_hz;
            last = now;
            if now < 0.0 {
                break time - now / (now - before) / config.frame_hz;
            }
            assert!(time < 10.0 * PI / known, "it never comes back");
        };
        let measured = PI / half_period;
        println!("{cells} cells: {measured:.1} rad/s, known {known:.1} rad/s");
        assert!((measured / known - 1.0).abs() < 0.08, "{measured} {known}");
    }
}

/// What the water loses the ball gets, whatever the surface does at it.
#[test]
fn a_ball_that_touches_a_drop_feels_all_of_it() {
    let radius = 0.005;
    let mut config = cube(radius, 12.0, 0.01);
    config.world.bodies = vec![body(Shape::Sphere { radius: 0.004 }, DVec3::X * 0.0088)];
    let mut run = Run::new(&config);
    let mass = config.settings.particle_mass();
    let (mut impulse, mut size) = (DVec3::ZERO, 0.0);
    let before = momentum(&run.snapshot(), mass);
    for _ in 0..60 {
        let force = run.frame().loads[0].force() / config.frame_hz;
        impulse += force;
        size += force.length();
    }
    let gained = momentum(&run.snapshot(), mass) - before;
    println!("fluid {gained}, ball {impulse}, of {size}");
    assert!(size > 1e-6 && (gained + impulse).length() < 1e-3 * size, "{gained} {impulse} {size}");
}
