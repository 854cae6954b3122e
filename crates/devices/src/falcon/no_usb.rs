//! In place of the USB transport, in builds without it.

use crate::falcon::{FalconError, PluggedIn, Transport};

/// Always an error.
///
/// # Errors
/// [`FalconError::NoUsb`].
pub fn plugged_in() -> Result<Vec<PluggedIn>, FalconError> {
    Err(absent())
}

/// Always an error.
///
/// # Errors
/// [`FalconError::NoUsb`].
pub fn open(_serial: Option<&str>) -> Result<Box<dyn Transport>, FalconError> {
    Err(absent())
}

fn absent() -> FalconError {
    FalconError::NoUsb { cause: "this build was made without the feature falcon".into() }
}
