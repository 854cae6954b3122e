//! Pictures: still frames of the fluid, and charts of what was felt.
//!
//! Everything is drawn in memory, on one thread, with no window, graphics card or system font.

pub mod chart;
pub mod error;
pub mod frame;
pub mod image;
pub mod scene;

mod arrow;
mod axis;
mod camera;
mod field;
mod floor;
mod font;
mod glass;
mod kernels;
mod march;
mod material;
mod mirror;
mod neighbours;
mod nozzle;
mod photons;
mod sky;
mod solid;
mod stroke;
mod tensor;
mod tracer;
