//! What a hand needs: tool state, wrench, filters, device mapping and the safety gate.
//!
//! Pure and thread-free: everything here is called from one servo tick. SI units, f64, right-handed, y up.
#![forbid(unsafe_code)]

mod types;

pub use types::{ToolState, Wrench};
