//! What the integration tests share: two scenes, and a fluid that is run frame by frame round one tool.
#![allow(dead_code, reason = "each test file is a crate of its own and uses its share")]

use glam::DVec3;
use hapflow_fluid::{
    Aabb, BodyConfig, BodyDrive, BodyMotion, BodySample, Container, CpuBackend, FluidBackend, FluidConfig,
    FluidSettings, FrameInput, FrameOutput, ParticleView, Shape, Solver, Source, World,
};
use std::f64::consts::PI;

/// All solvers.
pub const SOLVERS: [Solver; 3] = [Solver::Wcsph, Solver::Muller, Solver::Dfsph];

/// A box between two corners.
pub fn aabb(min: [f64; 3], max: [f64; 3]) -> Aabb {
    Aabb { min: DVec3::from(min), max: DVec3::from(max) }
}

/// A body of `shape` at `position`, 100 g.
pub fn body(shape: Shape, position: DVec3) -> BodyConfig {
    BodyConfig { shape, position, ..BodyConfig::default() }
}

/// A steady jet straight down, 20 mm and 1.5 m/s at the outlet.
pub fn tap(height: f64) -> Source {
    Source {
        name: "tap".into(),
        position: DVec3::Y * height,
        direction: DVec3::NEG_Y,
        diameter: 0.02,
        speed: 1.5,
        on: true,
        period: 0.0,
        duty: 1.0,
    }
}

/// A jet from 60 mm above a ball of 15 mm radius at the origin; what has passed the ball vanishes.
pub fn jet_scene(solver: Solver, spacing: f64) -> FluidConfig {
    let world = World {
        bounds: aabb([-0.12, -0.08, -0.12], [0.12, 0.1, 0.12]),
        sources: vec![tap(0.06)],
        bodies: vec![body(Shape::Sphere { radius: 0.015 }, DVec3::ZERO)],
        ..World::default()
    };
    let settings = FluidSettings { solver, spacing, ..FluidSettings::default() };
    FluidConfig { settings, world, frame_hz: 1000.0, threads: 1 }
}

/// A cube of water of `side`, `cells` particles along an edge, in an open box twice as high, with a ball of
/// `radius` at its middle. The floor is at y = 0.
pub fn tank_scene(solver: Solver, side: f64, cells: u32, radius: f64) -> FluidConfig {
    let half = 0.5 * side;
    let inner = aabb([-half, 0.0, -half], [half, 2.0 * side, half]);
    let world = World {
        bounds: aabb([-side, -0.5 * side, -side], [side, 3.0 * side, side]),
        container: Some(Container::open_box(inner)),
        pools: vec![aabb([-half, 0.0, -half], [half, side, half])],
        bodies: vec![body(Shape::Sphere { radius }, DVec3::Y * half)],
        ..World::default()
    };
    let settings = FluidSettings { solver, spacing: side / f64::from(cells), ..FluidSettings::default() };
    FluidConfig { settings, world, frame_hz: 100.0, threads: 1 }
}

/// A fluid that is run frame by frame.
pub struct Run {
    /// The backend.
    pub fluid: CpuBackend,
    /// What it runs with.
    pub config: FluidConfig,
}

impl Run {
    /// A fluid of `config`.
    pub fn new(config: &FluidConfig) -> Self {
        Self { fluid: CpuBackend::new(config).unwrap(), config: config.clone() }
    }

    /// Takes new settings between frames.
    pub fn configure(&mut self, config: &FluidConfig) {
        self.fluid.configure(config).unwrap();
        self.config = config.clone();
    }

    /// One frame in which the tool follows `path` by `drive`.
    pub fn frame_with(&mut self, drive: BodyDrive, path: &[BodySample]) -> FrameOutput {
        let duration = 1.0 / self.config.frame_hz;
        let motion = BodyMotion { drive, path };
        let bodies = &[motion][..self.config.world.bodies.len().min(1)];
        self.fluid.submit(&FrameInput { duration, bodies });
        self.fluid.poll().unwrap().clone()
    }

    /// One frame in which the tool stands where the scene put it.
    pub fn frame(&mut self) -> FrameOutput {
        let position = self.config.world.bodies.first().map_or(DVec3::ZERO, |b| b.position);
        self.frame_with(BodyDrive::Led, &[BodySample::at(position)])
    }

    /// Runs for `seconds` with the tool at rest; the last frame's output.
    pub fn run(&mut self, seconds: f64) -> FrameOutput {
        let frames = (seconds * self.config.frame_hz).round() as usize;
        (0..frames).map(|_| self.frame()).last().unwrap_or_default()
    }

    /// Runs for `seconds` with the tool at rest; mean force on it, N.
    pub fn mean_force(&mut self, seconds: f64) -> DVec3 {
        let frames = (seconds * self.config.frame_hz).round() as usize;
        (0..frames).map(|_| self.frame().loads[0].force()).sum::<DVec3>() / frames as f64
    }

    /// The particles.
    pub fn snapshot(&mut self) -> ParticleView {
        let mut view = ParticleView::default();
        self.fluid.snapshot(&mut view);
        view
    }
}

/// A particle's position or velocity in f64.
pub fn vector(row: &[f32; 3]) -> DVec3 {
    DVec3::new(row[0].into(), row[1].into(), row[2].into())
}

/// Sum of the particles' momenta, N·s.
pub fn momentum(view: &ParticleView, particle_mass: f64) -> DVec3 {
    view.velocities.iter().map(vector).sum::<DVec3>() * particle_mass
}

/// Sum of the particles' kinetic energies, J.
pub fn kinetic_energy(view: &ParticleView, particle_mass: f64) -> f64 {
    view.velocities.iter().map(|v| 0.5 * particle_mass * vector(v).length_squared()).sum()
}

/// Highest speed of a particle, m/s.
pub fn top_speed(view: &ParticleView) -> f64 {
    view.velocities.iter().map(|v| vector(v).length()).fold(0.0, f64::max)
}

/// Every number is finite, and every column has one entry a particle.
pub fn assert_finite(view: &ParticleView, what: &str) {
    let n = view.ids.len();
    assert_eq!([view.positions.len(), view.velocities.len(), view.pressures.len()], [n; 3], "{what}");
    let rows = view.positions.iter().chain(&view.velocities).flatten();
    assert!(rows.chain(&view.pressures).all(|x| x.is_finite()), "{what}: a number is not finite");
}

/// Volume of a ball, m³.
pub fn ball_volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}
