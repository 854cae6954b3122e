//! What any thread may do with a session.

use crate::Scene;
use crate::force_limit::ForceLimit;
use hapflow_haptics::{FaultSet, RangeError};
use hapflow_realtime::SharedFlags;

/// Asks a tool to forget its faults. No fault has this bit.
pub(crate) const CLEAR: u32 = 1 << 31;

/// What any thread may do with a session: raise and clear faults, and limit its forces.
#[derive(Clone, Debug)]
pub struct Control {
    pub(crate) flags: SharedFlags,
    pub(crate) limit: ForceLimit,
    /// One for each tool, whose gate answers it by itself: [`CLEAR`], and which faults were taken back.
    pub(crate) clear: Vec<SharedFlags>,
}

impl Control {
    /// For a session of `scene`.
    pub(crate) fn new(scene: &Scene) -> Self {
        let clear = scene.tools().map(|_| SharedFlags::new()).collect();
        Self { flags: SharedFlags::new(), limit: ForceLimit::new(scene.gate), clear }
    }

    /// No force from the next tick on, until [`clear_faults`](Self::clear_faults). Thread: any.
    pub fn emergency_stop(&self) {
        self.raise(FaultSet::EMERGENCY_STOP);
    }

    /// Raises faults, on all tools from their next tick on. Thread: any.
    pub fn raise(&self, faults: FaultSet) {
        self.flags.raise(faults.bits());
    }

    /// Takes back every fault; the force ramps in. Thread: any.
    pub fn clear_faults(&self) {
        let raised = self.flags.clear(u32::MAX);
        for tool in &self.clear {
            tool.raise(raised | CLEAR);
        }
    }

    /// From the next tick on no tool's force is larger than `max_force_n` (N) and no torque than `max_torque_nm`
    /// (N·m), for the rest of the session: a limit can be lowered and never raised. Thread: any.
    ///
    /// # Errors
    /// A number that is not from 0 to the present limit; nothing changes then.
    pub fn limit_force(&self, max_force_n: f64, max_torque_nm: f64) -> Result<(), RangeError> {
        self.limit.lower(max_force_n, max_torque_nm)
    }

    /// Faults that are raised. Thread: any.
    pub fn faults(&self) -> FaultSet {
        FaultSet::from_bits(self.flags.load())
    }
}
