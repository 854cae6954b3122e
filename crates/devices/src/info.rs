//! Which devices there are.

use crate::{DeviceError, HandSettings};

/// What a person needs to know to choose a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceInfo {
    /// Its name, as it is asked for.
    pub name: &'static str,
    /// One line about it.
    pub about: &'static str,
    /// Degrees of freedom that it measures, 0 to 6: 3 are the position alone.
    pub sensed_dof: u8,
    /// Degrees of freedom that it drives, 0 to 6: 3 are the force alone.
    pub driven_dof: u8,
    /// Largest force, N; 0 where the hand feels nothing.
    pub max_force_n: f64,
    /// True for a machine that a person holds, false for a simulated one.
    pub hardware: bool,
}

const DEVICES: [DeviceInfo; 3] = [
    DeviceInfo {
        name: "null",
        about: "stays at one place and feels nothing",
        sensed_dof: 3,
        driven_dof: 0,
        max_force_n: 0.0,
        hardware: false,
    },
    DeviceInfo {
        name: "replay",
        about: "follows a motion from a CSV file or a built-in one, and feels nothing",
        sensed_dof: 3,
        driven_dof: 0,
        max_force_n: 0.0,
        hardware: false,
    },
    DeviceInfo {
        name: "hand",
        about: "a simulated hand that follows a script and gives way to the force",
        sensed_dof: 3,
        driven_dof: 3,
        max_force_n: HandSettings::MAX_FORCE_N,
        hardware: false,
    },
];

/// Every device that this build knows. Allocates.
pub fn list() -> Vec<DeviceInfo> {
    DEVICES.to_vec()
}

/// The device called `name`.
///
/// # Errors
/// [`DeviceError::Unknown`], which lists the names that there are.
pub fn find(name: &str) -> Result<DeviceInfo, DeviceError> {
    DEVICES.into_iter().find(|info| info.name == name).ok_or_else(|| DeviceError::Unknown {
        name: name.to_owned(),
        known: DEVICES.map(|info| info.name).join(", "),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_device_is_found() {
        for info in list() {
            assert_eq!(find(info.name), Ok(info));
            assert!(info.sensed_dof <= 6 && info.driven_dof <= 6);
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let error = find("falcn").unwrap_err().to_string();
        assert_eq!(error, "unknown device \"falcn\": choose one of null, replay, hand");
    }
}
