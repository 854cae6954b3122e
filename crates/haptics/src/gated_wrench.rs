//! The only wrench that a device takes.

use crate::Wrench;
use glam::DVec3;

/// A wrench that has passed a [`SafetyGate`](crate::SafetyGate): finite, limited in size and in change.
/// Nothing but the gate makes one, so no force reaches a hand around it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GatedWrench(Wrench);

impl GatedWrench {
    /// No force and no torque: always safe.
    pub const ZERO: Self = Self(Wrench::ZERO);

    /// For the gate alone.
    pub(crate) fn new(wrench: Wrench) -> Self {
        Self(wrench)
    }

    /// Force, N.
    pub fn force(&self) -> DVec3 {
        self.0.force
    }

    /// Torque about the tool point, N·m.
    pub fn torque(&self) -> DVec3 {
        self.0.torque
    }

    /// Both, for reports and recordings.
    pub fn wrench(&self) -> Wrench {
        self.0
    }
}
