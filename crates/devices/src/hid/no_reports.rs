//! In place of the system's HID devices, in builds without them.

use crate::DeviceError;

/// Never there.
pub struct Reports;

impl Reports {
    pub fn open(device: &'static str) -> Result<Self, DeviceError> {
        let (cause, remedy) = ("this build has no HID", "build it with the feature hid");
        Err(DeviceError::Unavailable { device, cause, remedy })
    }

    pub fn next(&mut self, _report: &mut [u8]) -> Result<usize, ()> {
        Err(())
    }
}
