//! Viscosity between walls: the profiles that are known exactly.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{Run, aabb, vector};
use glam::DVec3;
use hapflow_fluid::{
    BodyConfig, BodyDrive, BodyMotion, BodySample, FluidBackend, FluidConfig, FluidSettings, FrameInput,
    Shape, World,
};

const GAP: f64 = 0.02;

/// A layer between two slabs, `cells` particles thick.
fn layer(cells: u32, viscosity: f64) -> FluidConfig {
    let (half, wide) = (0.5 * GAP, 0.625 * GAP);
    let slab = |y: f64| BodyConfig {
        shape: Shape::Slab { thickness: 0.02 },
        position: DVec3::Y * y,
        ..BodyConfig::default()
    };
    let world = World {
        bounds: aabb([-wide, -GAP, -wide], [wide, GAP, wide]),
        periodic: [true, false, true],
        pools: vec![aabb([-wide, -half, -wide], [wide, half, wide])],
        bodies: vec![slab(-half - 0.01), slab(half + 0.01)],
        ..World::default()
    };
    let settings = FluidSettings {
        spacing: GAP / f64::from(cells),
        viscosity,
        gravity: DVec3::ZERO,
        sound_speed: 1.0,
        background_pressure: 20.0,
        ..FluidSettings::default()
    };
    // A stiff one stands within milliseconds.
    let frame_hz = if viscosity > 10.0 { 1000.0 } else { 200.0 };
    FluidConfig { settings, world, frame_hz, threads: 1 }
}

/// Runs the layer with its upper slab at `speed`; the error of the profile in the mean square, over `scale`, and the
/// viscous force on the slabs.
fn profile_error(
    config: &FluidConfig,
    speed: f64,
    scale: f64,
    exact: impl Fn(f64) -> f64,
) -> (f64, [f64; 2]) {
    let mut run = Run::new(config);
    let dt = 1.0 / config.frame_hz;
    // The slowest mode decays with pi^2 nu / gap^2: to e^-15.
    let frames = (1.5 * GAP * GAP / config.settings.kinematic_viscosity() / dt).ceil().max(30.0) as u32;
    let mut force = [0.0; 2];
    for k in 0..frames {
        let paths = config.world.bodies.each_ref_at(k, speed, dt);
        let motions: Vec<_> = paths.iter().map(|p| BodyMotion { drive: BodyDrive::Led, path: p }).collect();
        run.fluid.submit(&FrameInput { duration: dt, bodies: &motions });
        let output = run.fluid.poll().unwrap();
        // Mean over the last half, when the flow stands.
        if 2 * k >= frames {
            let share = 1.0 / f64::from(frames - frames / 2);
            force[0] += output.loads[0].viscous_force.x * share;
            force[1] += output.loads[1].viscous_force.x * share;
        }
    }
    let view = run.snapshot();
    let errors =
        view.positions.iter().zip(&view.velocities).map(|(x, v)| (vector(v).x - exact(vector(x).y)).powi(2));
    ((errors.sum::<f64>() / view.positions.len() as f64).sqrt() / scale, force)
}

trait Paths {
    fn each_ref_at(&self, frame: u32, speed: f64, dt: f64) -> Vec<[BodySample; 2]>;
}

impl Paths for Vec<BodyConfig> {
    /// The first stays, the second slides along x.
    fn each_ref_at(&self, frame: u32, speed: f64, dt: f64) -> Vec<[BodySample; 2]> {
        let speeds = [0.0, speed];
        let sample = |b: &BodyConfig, speed: f64, k: u32| BodySample {
            time: f64::from(k) * dt,
            velocity: DVec3::X * speed,
            ..BodySample::at(b.position + DVec3::X * (speed * dt * f64::from(k)))
        };
        self.iter().zip(speeds).map(|(b, v)| [sample(b, v, frame), sample(b, v, frame + 1)]).collect()
    }
}

#[test]
fn couette_flow_is_a_straight_line_and_its_walls_feel_it() {
    for (cells, viscosity, speed) in [(8, 0.5, 0.05), (12, 0.2, 0.04), (8, 100.0, 0.05), (12, 1000.0, 0.05)] {
        let config = layer(cells, viscosity);
        let (error, force) = profile_error(&config, speed, speed, |y| speed * (y / GAP + 0.5));
        let shear = viscosity * speed / GAP * (1.25 * GAP).powi(2);
        println!(
            "couette {cells}, {viscosity} Pa·s: {error:.4}, force {:.4} {:.4}",
            force[0] / shear,
            -force[1] / shear
        );
        assert!(error < 0.02, "{error}");
        assert!(
            (force[0] / shear - 1.0).abs() < 0.05 && (-force[1] / shear - 1.0).abs() < 0.05,
            "{force:?} {shear}"
        );
    }
}

#[test]
fn poiseuille_flow_is_a_parabola() {
    for (cells, viscosity) in [(8, 0.5), (12, 0.3), (8, 100.0), (12, 100.0)] {
        let mut config = layer(cells, viscosity);
        let pull = 0.04 * 8.0 * config.settings.kinematic_viscosity() / (GAP * GAP);
        config.settings.gravity = DVec3::X * pull;
        let (error, _) = profile_error(&config, 0.0, 0.04, |y| 0.04 * (1.0 - (2.0 * y / GAP).powi(2)));
        println!("poiseuille {cells}, {viscosity} Pa·s: {error:.4}");
        assert!(error < 0.025, "{error}");
    }
}
