//! `hapflow_wrench`: what the hand feels.

use crate::contract::as_in_header;
use hapflow_haptics::GatedWrench;

/// `hapflow_wrench`. It never grows, so that it can be written, as zero, whatever else is wrong.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct WrenchOut {
    force: [f64; 3],
    torque: [f64; 3],
}

as_in_header!(WrenchOut = hapflow_wrench { force, torque });

impl WrenchOut {
    /// No force and no torque.
    pub const ZERO: Self = Self { force: [0.0; 3], torque: [0.0; 3] };
}

impl From<GatedWrench> for WrenchOut {
    fn from(sent: GatedWrench) -> Self {
        Self { force: sent.force().to_array(), torque: sent.torque().to_array() }
    }
}
