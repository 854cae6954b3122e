//! The one interface to a fluid, whoever computes it.

use crate::{BodyLoad, BodyMotion, BodyState, FluidConfig, Surroundings};
use glam::DVec3;

/// What a backend refuses, and why.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FluidError {
    /// A setting outside its range.
    #[error("{field} = {value} is outside its range {min} to {max}")]
    Range {
        /// Name of the setting.
        field: &'static str,
        /// Its value.
        value: f64,
        /// Smallest allowed.
        min: f64,
        /// Largest allowed.
        max: f64,
    },
    /// A box whose corners are not finite or not in order.
    #[error("{name}: every coordinate of min {min} must be below that of max {max}, and finite")]
    Box {
        /// Which box.
        name: &'static str,
        /// Its lower corner.
        min: DVec3,
        /// Its upper corner.
        max: DVec3,
    },
    /// Settings that would need too many sub-steps to be stable.
    #[error(
        "{cause} is too high to be stepped stably: {needed} sub-steps a frame at {frame_hz} Hz with spacing \
         {spacing} m, and fluid.max_substeps allows {allowed}; raise fluid.max_substeps, run.fluid_hz or \
         fluid.spacing, or lower {cause}"
    )]
    TooStiff {
        /// The setting to blame.
        cause: &'static str,
        /// Sub-steps that stability needs.
        needed: usize,
        /// Sub-steps allowed.
        allowed: usize,
        /// Frame rate, Hz.
        frame_hz: f64,
        /// Spacing, m.
        spacing: f64,
    },
    /// More particles than allowed.
    #[error(
        "the fluid would be {needed} particles and fluid.max_particles allows {allowed}; raise it or fluid.spacing"
    )]
    TooManyParticles {
        /// Particles wanted.
        needed: usize,
        /// Particles allowed.
        allowed: usize,
    },
    /// Something that this backend cannot do.
    #[error("backend {backend}: {what}")]
    Unsupported {
        /// The backend.
        backend: &'static str,
        /// What it lacks.
        what: String,
    },
    /// The worker threads could not be made.
    #[error("worker threads: {0}")]
    Threads(String),
}

/// One fluid frame to be stepped.
#[derive(Clone, Copy, Debug)]
pub struct FrameInput<'a> {
    /// Length of the frame, s.
    pub duration: f64,
    /// Motion of each body, in the order of [`crate::World::bodies`].
    pub bodies: &'a [BodyMotion<'a>],
}

/// What came of one fluid frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameOutput {
    /// Fluid time at the end of the frame, s.
    pub time: f64,
    /// Mean load of the fluid on each body over the frame.
    pub loads: Vec<BodyLoad>,
    /// State of each body at the end of the frame.
    pub bodies: Vec<BodyState>,
    /// Particles at the end of the frame.
    pub particles: usize,
    /// Sub-steps taken.
    pub substeps: usize,
    /// Iterations of the solves of all sub-steps; 0 where nothing is solved by iteration.
    pub iterations: usize,
    /// Highest particle speed in the frame, m/s.
    pub max_speed: f64,
    /// True when the frame hit a limit: particles lost to non-finite values, or speeds cut by the last guard.
    pub degraded: bool,
}

/// Particles for drawing and for oracles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParticleView {
    /// Positions, m.
    pub positions: Vec<[f32; 3]>,
    /// Velocities, m/s.
    pub velocities: Vec<[f32; 3]>,
    /// Numbers that stay with a particle for its life.
    pub ids: Vec<u32>,
    /// Pressures, Pa.
    pub pressures: Vec<f32>,
}

/// A fluid that can be stepped. All calls come from the one thread that owns it.
pub trait FluidBackend: Send {
    /// Name by which a scene asks for it.
    fn name(&self) -> &'static str;

    /// Takes new settings between frames. On an error the old ones stay.
    fn configure(&mut self, config: &FluidConfig) -> Result<(), FluidError>;

    /// Begins one frame. A backend may compute it here or elsewhere.
    fn submit(&mut self, frame: &FrameInput<'_>);

    /// The result of the submitted frame, once; `None` while it is under way.
    fn poll(&mut self) -> Option<&FrameOutput>;

    /// Copies the particles out, for drawing: never on the step's path.
    fn snapshot(&mut self, view: &mut ParticleView);

    /// Fills `out` with the fluid within `reach` metres of `around` along each axis, after a frame: for couplings that look
    /// at it, and at no cost for others.
    fn surroundings(&mut self, around: DVec3, reach: f64, out: &mut Surroundings);
}
