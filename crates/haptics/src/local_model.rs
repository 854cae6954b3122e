//! What the servo gets of one fluid frame.

use crate::{Law, ToolState, Wrench};
use glam::DVec3;

/// Everything of one fluid frame that the servo needs to make a force by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LocalModel {
    /// Number of the frame, from 1; 0 says that there is none yet.
    pub frame: u64,
    /// When the tool path that it answers ended, s; ahead of its time where the coupling leads.
    pub path_end_s: f64,
    /// When it was handed over, s.
    pub published_s: f64,
    /// Length of a frame, s.
    pub frame_s: f64,
    /// The force and torque of that frame, scene frame, less the law's.
    pub wrench: Wrench,
    /// The force that depends on where the tool is.
    pub law: Law,
    /// Mass of fluid that goes along with the tool, kg.
    pub added_mass: f64,
    /// Where the tool's body was at its end, m.
    pub body: DVec3,
}

impl LocalModel {
    /// Whether it has no force for any tool.
    pub(crate) fn acts_not(&self) -> bool {
        self.wrench == Wrench::ZERO && self.added_mass == 0.0 && self.law.is_none()
    }

    /// The wrench on a tool in this state. Thread: servo.
    pub fn evaluate(&self, tool: &ToolState) -> Wrench {
        self.wrench + Wrench::from_force(self.law.at(tool))
    }
}
