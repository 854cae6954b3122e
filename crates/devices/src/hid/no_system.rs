//! In place of the system's HID devices, in builds without them.

use super::Reports;
use crate::DeviceError;

/// There never is one.
pub fn open(device: &'static str) -> Result<Box<dyn Reports>, DeviceError> {
    let (cause, remedy) = ("this build has no HID", "build it with the feature hid");
    Err(DeviceError::Unavailable { device, cause, remedy })
}
