//! Which devices there are.

use crate::falcon::{self, FalconError};
use crate::hid::SpaceMouse;
use crate::sdk::{ForceDimension, OpenHaptics};
use crate::{DeviceError, HandSettings};
use glam::DVec3;

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
    /// Largest stiffness that it renders without trembling, N/m; 0 where the hand feels nothing, or where the limit is
    /// not the device's.
    pub max_stiffness_n_per_m: f64,
    /// Largest damping that it renders without trembling, N·s/m; 0 likewise.
    pub max_damping_n_s_per_m: f64,
    /// Size of its workspace along x, y and z, m; 0 where there is no limit.
    pub workspace_m: [f64; 3],
    /// Usual rate, Hz.
    pub rate_hz: f64,
    /// True for a machine that a person holds, false for a simulated one.
    pub hardware: bool,
}

impl DeviceInfo {
    /// What there is of it now, or why there is nothing. Thread: main; asks the system.
    ///
    /// # Errors
    /// [`DeviceError`] with what a person can do.
    pub fn presence(&self) -> Result<String, DeviceError> {
        match self.name {
            "falcon" => {
                let found = falcon::plugged_in()?;
                let first = found.first().ok_or(FalconError::NotFound { serial: None })?;
                let serial = first.serial.clone()?;
                Ok(format!("{} plugged in, the first with serial number \"{serial}\"", found.len()))
            }
            "force-dimension" => match ForceDimension::count()? {
                0 => Err(DeviceError::Unavailable {
                    device: self.name,
                    cause: "its library finds none",
                    remedy: "check its cable and supply",
                }),
                count => Ok(format!("{count} plugged in")),
            },
            "touch" => OpenHaptics::open(DVec3::ZERO).map(|_| "it answers".into()),
            "spacemouse" => SpaceMouse::open(DVec3::ZERO).map(|_| "plugged in".into()),
            _ => Ok("always there".into()),
        }
    }
}

/// One that stays at one place.
pub const NULL: DeviceInfo = DeviceInfo {
    name: "null",
    about: "stays at one place and feels nothing",
    sensed_dof: 3,
    driven_dof: 0,
    max_force_n: 0.0,
    max_stiffness_n_per_m: 0.0,
    max_damping_n_s_per_m: 0.0,
    workspace_m: [0.0; 3],
    rate_hz: 1000.0,
    hardware: false,
};

/// One that follows a motion.
pub const REPLAY: DeviceInfo = DeviceInfo {
    name: "replay",
    about: "follows a motion from a CSV file or a built-in one, and feels nothing",
    ..NULL
};

/// A simulated hand.
pub const HAND: DeviceInfo = DeviceInfo {
    name: "hand",
    about: "a simulated hand that follows a script and gives way to the force",
    driven_dof: 3,
    max_force_n: HandSettings::MAX_FORCE_N,
    ..NULL
};

/// A Novint Falcon. Force: the weakest direction in the usual part of the workspace at full counts. Stiffness and damping:
/// the limits of its maker's own library.
pub const FALCON: DeviceInfo = DeviceInfo {
    name: "falcon",
    about: "a Novint Falcon by USB",
    driven_dof: 3,
    max_force_n: 8.0,
    max_stiffness_n_per_m: 3000.0,
    max_damping_n_s_per_m: 20.0,
    workspace_m: [0.1; 3],
    hardware: true,
    ..NULL
};

/// A Falcon that is not there.
pub const EMULATED_FALCON: DeviceInfo = DeviceInfo {
    name: "emulated-falcon",
    about: "a Novint Falcon that is emulated down to USB transfers, in a simulated hand",
    hardware: false,
    ..FALCON
};

/// A device of Force Dimension; the numbers are those of its smallest, the omega.3.
pub const FORCE_DIMENSION: DeviceInfo = DeviceInfo {
    name: "force-dimension",
    about: "an omega, delta or sigma of Force Dimension, or a Falcon on Windows, by its maker's library",
    driven_dof: 3,
    max_force_n: 12.0,
    max_stiffness_n_per_m: 14_500.0,
    workspace_m: [0.16, 0.16, 0.11],
    hardware: true,
    ..NULL
};

/// A device of 3D Systems; the numbers are those of the Touch.
pub const TOUCH: DeviceInfo = DeviceInfo {
    name: "touch",
    about: "a Touch of 3D Systems (formerly Phantom Omni), by its maker's library OpenHaptics",
    driven_dof: 3,
    max_force_n: 3.3,
    workspace_m: [0.16, 0.12, 0.07],
    hardware: true,
    ..NULL
};

/// A SpaceMouse. Rate: a report every 8 ms, as a SpaceNavigator was seen to send them.
pub const SPACE_MOUSE: DeviceInfo = DeviceInfo {
    name: "spacemouse",
    about: "a SpaceMouse of 3Dconnexion, whose cap moves the tool; no force",
    sensed_dof: 6,
    workspace_m: [2.0 * SpaceMouse::REACH_M; 3],
    rate_hz: 125.0,
    hardware: true,
    ..NULL
};

const DEVICES: [DeviceInfo; 8] =
    [NULL, REPLAY, HAND, FALCON, EMULATED_FALCON, FORCE_DIMENSION, TOUCH, SPACE_MOUSE];

/// Every device that this build knows. Allocates.
pub fn list() -> Vec<DeviceInfo> {
    DEVICES.to_vec()
}

/// The first device that is real and there, if there is one. Thread: main; asks the system.
pub fn first_present() -> Option<DeviceInfo> {
    DEVICES.into_iter().find(|info| info.hardware && info.presence().is_ok())
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
        assert_eq!(
            error,
            "unknown device \"falcn\": choose one of null, replay, hand, falcon, emulated-falcon, force-dimension, touch, spacemouse"
        );
    }
}
