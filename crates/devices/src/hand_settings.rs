//! How heavy, stiff and damped a simulated hand and its device are.

use hapflow_haptics::{RangeError, VelocityEstimator, check_range};

/// Ready-made hands, from none to a whole arm: the corners at which a coupling must be stable.
///
/// | name | mass, kg | damping, N·s/m | stiffness, N/m |
/// |---|---|---|---|
/// | `free` | 0 | 0 | 0 |
/// | `light` | 0.05 | 1 | 50 |
/// | `normal` | 0.15 | 4 | 300 |
/// | `firm` | 0.3 | 10 | 1000 |
/// | `arm` | 0.55 | 6.5 | 135 |
///
/// `arm` is a trial of an arm that held a device, measured in a paper of Scientific Reports (srep18004); the
/// others are typical figures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum HandPreset {
    /// Nobody holds the device: the script does nothing.
    Free,
    /// Two fingers, loosely.
    Light,
    /// A grip as for stirring.
    #[default]
    Normal,
    /// A tight grip.
    Firm,
    /// A whole arm.
    Arm,
}

impl HandPreset {
    /// All of them, weakest grip first.
    pub const ALL: [Self; 5] = [Self::Free, Self::Light, Self::Normal, Self::Firm, Self::Arm];

    /// Its name in a scene.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Light => "light",
            Self::Normal => "normal",
            Self::Firm => "firm",
            Self::Arm => "arm",
        }
    }

    /// The one called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// Mass, damping and stiffness.
    const fn numbers(self) -> [f64; 3] {
        match self {
            Self::Free => [0.0, 0.0, 0.0],
            Self::Light => [0.05, 1.0, 50.0],
            Self::Normal => [0.15, 4.0, 300.0],
            Self::Firm => [0.3, 10.0, 1000.0],
            Self::Arm => [0.55, 6.5, 135.0],
        }
    }
}

/// Settings of a [`SimulatedHand`](crate::SimulatedHand), the same along every axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandSettings {
    /// Moving mass of the device, kg, 0.02 to 10. Default 0.2: a small desktop device.
    pub device_mass_kg: f64,
    /// Viscous damping of the device, N·s/m, 0 to 50. Default 0.5: its bearings and motors.
    pub device_damping_n_s_per_m: f64,
    /// Dry (Coulomb) friction of the device, N, 0 to 5. Default 0.
    pub device_friction_n: f64,
    /// Time from the writing of a force until it acts, s, 0 to 0.05. Default 0; 1 to 3 ms by USB.
    pub transport_delay_s: f64,
    /// Mass of the hand that moves with it, kg, 0 to 10. Default 0.15 (`normal`).
    pub hand_mass_kg: f64,
    /// Damping of the hand against its wanted velocity, N·s/m, 0 to 50. Default 4 (`normal`).
    pub hand_damping_n_s_per_m: f64,
    /// Stiffness of the hand towards its wanted place, N/m, 0 to 5000. Default 300 (`normal`).
    pub hand_stiffness_n_per_m: f64,
    /// Step of the device's encoders, m, 0 to 0.01; 0 measures position and velocity perfectly. Default 0.
    /// With a step, position is rounded to it and velocity estimated from that, as with a real device.
    pub encoder_step_m: f64,
    /// Cutoff of that estimate, Hz, 1 to 10 000. Default [`VelocityEstimator::DEFAULT_CUTOFF_HZ`].
    pub velocity_cutoff_hz: f64,
}

impl HandSettings {
    /// Largest force that the simulated device is said to give, N: the most that a gate lets through.
    pub const MAX_FORCE_N: f64 = 50.0;

    /// The default device in a ready-made hand.
    pub fn preset(preset: HandPreset) -> Self {
        let [mass, damping, stiffness] = preset.numbers();
        Self {
            device_mass_kg: 0.2,
            device_damping_n_s_per_m: 0.5,
            device_friction_n: 0.0,
            transport_delay_s: 0.0,
            hand_mass_kg: mass,
            hand_damping_n_s_per_m: damping,
            hand_stiffness_n_per_m: stiffness,
            encoder_step_m: 0.0,
            velocity_cutoff_hz: VelocityEstimator::DEFAULT_CUTOFF_HZ,
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`RangeError`] for the first that is outside its range.
    pub fn check(&self) -> Result<(), RangeError> {
        check_range("device_mass_kg", self.device_mass_kg, 0.02, 10.0)?;
        check_range("device_damping_n_s_per_m", self.device_damping_n_s_per_m, 0.0, 50.0)?;
        check_range("device_friction_n", self.device_friction_n, 0.0, 5.0)?;
        check_range("transport_delay_s", self.transport_delay_s, 0.0, 0.05)?;
        check_range("hand_mass_kg", self.hand_mass_kg, 0.0, 10.0)?;
        check_range("hand_damping_n_s_per_m", self.hand_damping_n_s_per_m, 0.0, 50.0)?;
        check_range("hand_stiffness_n_per_m", self.hand_stiffness_n_per_m, 0.0, 5000.0)?;
        check_range("encoder_step_m", self.encoder_step_m, 0.0, 0.01)?;
        check_range("velocity_cutoff_hz", self.velocity_cutoff_hz, 1.0, 10_000.0)?;
        Ok(())
    }
}

impl Default for HandSettings {
    fn default() -> Self {
        Self::preset(HandPreset::Normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_in_range_and_found_by_name() {
        for preset in HandPreset::ALL {
            assert_eq!(HandSettings::preset(preset).check(), Ok(()));
            assert_eq!(HandPreset::from_name(preset.name()), Some(preset));
        }
        assert_eq!(HandPreset::from_name("iron"), None);
    }

    #[test]
    fn each_field_is_checked_by_name() {
        type Spoil = fn(&mut HandSettings);
        let spoil: [(&str, Spoil); 9] = [
            ("device_mass_kg", |s| s.device_mass_kg = 0.0),
            ("device_damping_n_s_per_m", |s| s.device_damping_n_s_per_m = -1.0),
            ("device_friction_n", |s| s.device_friction_n = 5.1),
            ("transport_delay_s", |s| s.transport_delay_s = 0.06),
            ("hand_mass_kg", |s| s.hand_mass_kg = f64::NAN),
            ("hand_damping_n_s_per_m", |s| s.hand_damping_n_s_per_m = 51.0),
            ("hand_stiffness_n_per_m", |s| s.hand_stiffness_n_per_m = f64::INFINITY),
            ("encoder_step_m", |s| s.encoder_step_m = 0.02),
            ("velocity_cutoff_hz", |s| s.velocity_cutoff_hz = 0.0),
        ];
        for (field, spoil) in spoil {
            let mut settings = HandSettings::default();
            spoil(&mut settings);
            assert_eq!(settings.check().unwrap_err().field, field);
        }
    }
}
