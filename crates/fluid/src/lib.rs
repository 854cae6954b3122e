//! The fluid: smoothed particle hydrodynamics (SPH) in three dimensions, and what stands in it.
//!
//! A [`FluidBackend`] takes a [`FluidConfig`], steps one *fluid frame* at a time while the bodies follow the
//! motion they are given, and answers with the load of the fluid on each body. Backends:
//! [`CpuBackend`] (solvers [`Solver::Muller`], [`Solver::Wcsph`] and [`Solver::Dfsph`], rayon and SIMD) and [`AnalyticJet`]
//! (closed form). [`twin`] is the plain scalar oracle that tests compare with, and [`ControlVolume`] the balance of
//! momentum that knows nothing of loads.
//!
//! SI units, right-handed, y up; f32 in the particles, f64 at the border. Nothing here knows of devices,
//! threads of others or haptics.
#![forbid(unsafe_code)]

mod analytic_jet;
mod backend;
mod body;
mod config;
mod container;
mod control_volume;
mod cpu;
mod emitter;
mod grid;
pub mod kernel;
mod lanes;
mod limits;
mod liquid;
mod meetings;
mod mesh;
mod motion;
mod neighbours;
mod node_grid;
mod pair_kernel;
mod particles;
mod periodic;
mod pools;
mod restack;
mod rigid;
mod shape;
mod sleep;
mod solids;
mod solver;
mod stages;
mod surroundings;
mod triangle;
mod triangle_tree;
pub mod twin;
mod vector_unit;
mod volume_map;
mod wall;

pub use analytic_jet::{AnalyticJet, jet_force};
pub use backend::{FluidBackend, FluidError, FrameInput, FrameOutput, ParticleView};
pub use body::{BodyDrive, BodyLoad, BodyMotion, BodySample, BodyState, MIN_MASS_RATIO};
pub use config::{Aabb, BodyConfig, FluidConfig, FluidSettings, InteractionMode, Solver, Source, World};
pub use container::{Container, ContainerForm};
pub use control_volume::ControlVolume;
pub use cpu::CpuBackend;
pub use kernel::Kernel;
pub use limits::{StepLimits, step_limits};
pub use liquid::{Liquid, LiquidProperties};
pub use mesh::{MAX_TRIANGLES, Mesh, MeshError};
pub use shape::Shape;
pub use stages::{Stage, StageTimes};
pub use surroundings::Surroundings;
