//! What a session's forces may be at most: a limit that only falls.

use crate::SceneError;
use hapflow_haptics::{GateSettings, RangeError, SafetyGate, check_range};
use hapflow_realtime::Ceiling;

/// The gate of the scene as the session was made is the most that will ever leave it; force and torque may be limited
/// further, for all tools and for good. Thread: any; lock-free.
#[derive(Clone, Debug)]
pub(crate) struct ForceLimit {
    first: GateSettings,
    force: Ceiling,
    torque: Ceiling,
}

impl ForceLimit {
    pub fn new(first: GateSettings) -> Self {
        let (force, torque) = (Ceiling::new(first.max_force_n), Ceiling::new(first.max_torque_nm));
        Self { first, force, torque }
    }

    /// Lowers both, or neither. Of two calls at once the lower of each counts.
    pub fn lower(&self, max_force_n: f64, max_torque_nm: f64) -> Result<(), RangeError> {
        check_range("max_force_N", max_force_n, 0.0, self.force.get())?;
        check_range("max_torque_Nm", max_torque_nm, 0.0, self.torque.get())?;
        self.force.lower(max_force_n);
        self.torque.lower(max_torque_nm);
        Ok(())
    }

    /// Brings a gate below the limit. Thread: servo.
    pub fn hold(&self, gate: &mut SafetyGate) {
        gate.lower(self.force.get(), self.torque.get());
    }

    /// The settings with the limit in force.
    pub fn applied(&self, gate: GateSettings) -> GateSettings {
        let (max_force_n, max_torque_nm) =
            (gate.max_force_n.min(self.force.get()), gate.max_torque_nm.min(self.torque.get()));
        GateSettings { max_force_n, max_torque_nm, ..gate }
    }

    /// Refuses settings that would let more out than the limit.
    pub fn check(&self, gate: &GateSettings) -> Result<(), SceneError> {
        let first = &self.first;
        let limits = [
            ("gate.max_force", gate.max_force_n, self.force.get(), "N"),
            ("gate.max_torque", gate.max_torque_nm, self.torque.get(), "N·m"),
            ("gate.max_slew", gate.max_slew_n_per_s, first.max_slew_n_per_s, "N/s"),
            ("gate.max_torque_slew", gate.max_torque_slew_nm_per_s, first.max_torque_slew_nm_per_s, "N·m/s"),
        ];
        match limits.into_iter().find(|(_, value, most, _)| value > most) {
            None => Ok(()),
            Some((path, value, most, unit)) => Err(SceneError::BadValue {
                path: path.into(),
                value: value.to_string(),
                expected: format!("at most {most} {unit}: while a session runs it may only be lowered"),
            }),
        }
    }
}
