//! How much force a hand may get, and how suddenly.

use crate::{RangeError, check_range};

/// Settings of a [`SafetyGate`](crate::SafetyGate). They may change while it runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GateSettings {
    /// Largest force, N, 0 to 50. Default 4: well felt, and held by two fingers; a small desktop device gives
    /// no more for long.
    pub max_force_n: f64,
    /// Largest torque, N·m, 0 to 5. Default 0.1: what a 4 N force does at 25 mm, a finger's width from the
    /// tool point, and within what small devices with torque can give for long.
    pub max_torque_nm: f64,
    /// Fastest change of the force, N/s, 1 to 1 000 000. Default 1000: from nothing to 4 N in 4 ms. Contact
    /// with water stays below some 400 N/s, and hitting a wall of 1000 N/m at 0.5 m/s needs 500 N/s, so only
    /// jumps are cut.
    pub max_slew_n_per_s: f64,
    /// Fastest change of the torque, N·m/s, 0.01 to 100 000. Default 25: as fast in its own range as the
    /// force.
    pub max_torque_slew_nm_per_s: f64,
    /// Time in which the force comes up after a start, a cleared fault or stale data, s, 0 to 10. Default
    /// 0.5: long enough to feel what comes and to let go.
    pub ramp_in_s: f64,
    /// Age of the fluid's data, in fluid frames, above which it is stale; 1 to 1000. Default 3: one frame is
    /// usual, two happen.
    pub stale_hold_frames: f64,
    /// Time in which a full force fades once the data is stale, s, 0 to 10. Default 0.1: no blow, and short
    /// beside the half second that a hand takes to react.
    pub stale_fade_s: f64,
}

impl Default for GateSettings {
    fn default() -> Self {
        Self {
            max_force_n: 4.0,
            max_torque_nm: 0.1,
            max_slew_n_per_s: 1000.0,
            max_torque_slew_nm_per_s: 25.0,
            ramp_in_s: 0.5,
            stale_hold_frames: 3.0,
            stale_fade_s: 0.1,
        }
    }
}

impl GateSettings {
    /// Checks every number.
    ///
    /// # Errors
    /// [`RangeError`] for the first that is outside its range.
    pub fn check(&self) -> Result<(), RangeError> {
        check_range("max_force_n", self.max_force_n, 0.0, 50.0)?;
        check_range("max_torque_nm", self.max_torque_nm, 0.0, 5.0)?;
        check_range("max_slew_n_per_s", self.max_slew_n_per_s, 1.0, 1e6)?;
        check_range("max_torque_slew_nm_per_s", self.max_torque_slew_nm_per_s, 0.01, 1e5)?;
        check_range("ramp_in_s", self.ramp_in_s, 0.0, 10.0)?;
        check_range("stale_hold_frames", self.stale_hold_frames, 1.0, 1000.0)?;
        check_range("stale_fade_s", self.stale_fade_s, 0.0, 10.0)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_in_range() {
        assert_eq!(GateSettings::default().check(), Ok(()));
    }

    #[test]
    fn each_field_is_checked_by_name() {
        type Spoil = fn(&mut GateSettings);
        let spoil: [(&str, Spoil); 7] = [
            ("max_force_n", |s| s.max_force_n = 50.1),
            ("max_torque_nm", |s| s.max_torque_nm = -0.1),
            ("max_slew_n_per_s", |s| s.max_slew_n_per_s = 0.0),
            ("max_torque_slew_nm_per_s", |s| s.max_torque_slew_nm_per_s = f64::INFINITY),
            ("ramp_in_s", |s| s.ramp_in_s = -1.0),
            ("stale_hold_frames", |s| s.stale_hold_frames = 0.5),
            ("stale_fade_s", |s| s.stale_fade_s = f64::NAN),
        ];
        for (field, spoil) in spoil {
            let mut settings = GateSettings::default();
            spoil(&mut settings);
            assert_eq!(settings.check().unwrap_err().field, field);
        }
    }
}
