//! What a device cannot do, and what a person can do about it.

use crate::falcon::FalconError;
use crate::{MotionError, ScriptError};
use hapflow_haptics::RangeError;

/// Why a device was refused or failed. Each text says what a person can do, or what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DeviceError {
    /// No device has that name.
    #[error("unknown device \"{name}\": choose one of {known}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// The device is not there, or cannot be opened.
    #[error("{device} cannot be opened, {cause}: {remedy}")]
    Unavailable {
        /// Its name.
        device: &'static str,
        /// What stands in the way.
        cause: &'static str,
        /// What a person can do.
        remedy: &'static str,
    },
    /// The device, or its maker's library, refuses to be opened.
    #[error("{device} cannot be opened, {cause}: {remedy}")]
    Refused {
        /// Its name.
        device: &'static str,
        /// What it says.
        cause: String,
        /// What a person can do.
        remedy: &'static str,
    },
    /// The device answered once but does not any more.
    #[error("{device} does not answer any more, {cause}: {remedy}")]
    Lost {
        /// Its name.
        device: &'static str,
        /// What happened.
        cause: &'static str,
        /// What a person can do.
        remedy: &'static str,
    },
    /// The device was used after it was closed.
    #[error("{device} is closed: open it again")]
    Closed {
        /// Its name.
        device: &'static str,
    },
    /// A setting outside its range.
    #[error("{0}: choose a value inside it")]
    Setting(#[from] RangeError),
    /// A Falcon that cannot be used, or is lost.
    #[error(transparent)]
    Falcon(#[from] FalconError),
    /// A motion that cannot be followed.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A script that cannot be followed.
    #[error(transparent)]
    Script(#[from] ScriptError),
}

impl DeviceError {
    /// Nothing, or [`Closed`](Self::Closed) for a device that is.
    pub(crate) fn if_closed(closed: bool, device: &'static str) -> Result<(), Self> {
        if closed { Err(Self::Closed { device }) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_end_with_a_remedy() {
        let lost = DeviceError::Lost { device: "falcon", cause: "its cable is out", remedy: "plug it in" };
        assert_eq!(lost.to_string(), "falcon does not answer any more, its cable is out: plug it in");
        let range = RangeError { field: "device_mass_kg", value: 0.0, min: 0.02, max: 10.0 };
        let expected = "device_mass_kg = 0 is outside its range 0.02 to 10: choose a value inside it";
        assert_eq!(DeviceError::from(range).to_string(), expected);
    }
}
