//! A device that does nothing.

use crate::{DeviceError, HapticDevice, Pacing};
use glam::DVec3;
use hapflow_haptics::{GatedWrench, ToolState};

/// Stays at one place and feels nothing: for scenes without a hand, and for measuring a steady force.
#[derive(Clone, Debug)]
pub struct NullDevice {
    position: DVec3,
    closed: bool,
}

impl NullDevice {
    /// At rest at `position`, m.
    pub fn new(position: DVec3) -> Self {
        Self { position, closed: false }
    }
}

impl HapticDevice for NullDevice {
    fn name(&self) -> &str {
        "null"
    }

    fn pacing(&self) -> Pacing {
        Pacing::Timer
    }

    fn read(&mut self, _time_s: f64) -> Result<ToolState, DeviceError> {
        DeviceError::if_closed(self.closed, "null")?;
        Ok(ToolState::at(self.position))
    }

    fn write(&mut self, _wrench: GatedWrench, _dt_s: f64) -> Result<(), DeviceError> {
        DeviceError::if_closed(self.closed, "null")
    }

    fn close(&mut self) {
        self.closed = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_stays_until_it_is_closed() {
        let mut device = NullDevice::new(DVec3::Y);
        for time in [0.0, 1.0, 1e6] {
            assert_eq!(device.read(time), Ok(ToolState::at(DVec3::Y)));
            assert_eq!(device.write(GatedWrench::ZERO, 1e-3), Ok(()));
        }
        device.close();
        device.close();
        assert_eq!(device.read(0.0), Err(DeviceError::Closed { device: "null" }));
        assert!(device.write(GatedWrench::ZERO, 1e-3).is_err());
    }
}
