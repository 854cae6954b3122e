//! `hapflow_wrench`: what the hand feels.

use crate::caller::Plain;
use crate::contract::as_in_header;
use glam::DVec3;
use hapflow_haptics::{GatedWrench, Wrench};

/// `hapflow_wrench`. It never grows, so that it can be written, as zero, whatever else is wrong.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct WrenchRecord {
    force: [f64; 3],
    torque: [f64; 3],
}

as_in_header!(WrenchRecord = hapflow_wrench { force, torque });

// SAFETY: repr(C), six numbers.
unsafe impl Plain for WrenchRecord {}

impl WrenchRecord {
    /// No force and no torque.
    pub const ZERO: Self = Self { force: [0.0; 3], torque: [0.0; 3] };
}

impl From<GatedWrench> for WrenchRecord {
    fn from(sent: GatedWrench) -> Self {
        Self { force: sent.force().to_array(), torque: sent.torque().to_array() }
    }
}

impl From<WrenchRecord> for Wrench {
    fn from(given: WrenchRecord) -> Self {
        Self { force: DVec3::from(given.force), torque: DVec3::from(given.torque) }
    }
}
