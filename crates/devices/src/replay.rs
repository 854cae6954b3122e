//! A device that follows a recorded motion.

use crate::{AtEnd, DeviceError, HapticDevice, Motion, Pacing};
use glam::DVec3;
use hapflow_haptics::{GatedWrench, ToolState, check_range};

/// Follows a [`Motion`] from a given place and feels nothing: the same hand for every method that is
/// compared.
#[derive(Clone, Debug)]
pub struct Replay {
    motion: Motion,
    start: DVec3,
    at_end: AtEnd,
    closed: bool,
}

impl Replay {
    /// `start` is added to every position, m, within ±1000; the motion's own time is the session's.
    ///
    /// # Errors
    /// [`DeviceError::Motion`] if it is to repeat but does not end where it begins, [`DeviceError::Setting`]
    /// if `start` is outside its range.
    pub fn new(motion: Motion, start: DVec3, at_end: AtEnd) -> Result<Self, DeviceError> {
        check_range("start x (m)", start.x, -1e3, 1e3)?;
        check_range("start y (m)", start.y, -1e3, 1e3)?;
        check_range("start z (m)", start.z, -1e3, 1e3)?;
        if at_end == AtEnd::Repeat {
            motion.check_closed()?;
        }
        Ok(Self { motion, start, at_end, closed: false })
    }

    /// What it follows.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }
}

impl HapticDevice for Replay {
    fn name(&self) -> &str {
        "replay"
    }

    fn pacing(&self) -> Pacing {
        Pacing::Timer
    }

    fn read(&mut self, time_s: f64) -> Result<ToolState, DeviceError> {
        DeviceError::if_closed(self.closed, "replay")?;
        let point = self.motion.at(time_s, self.at_end);
        Ok(ToolState { velocity: point.velocity, ..ToolState::at(self.start + point.position) })
    }

    fn write(&mut self, _wrench: GatedWrench, _dt_s: f64) -> Result<(), DeviceError> {
        DeviceError::if_closed(self.closed, "replay")
    }

    fn close(&mut self) {
        self.closed = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line() -> Motion {
        Motion::parse("time_s,x_m,y_m,z_m\n0,0,0,0\n2,1,0,0\n", "line.csv").unwrap()
    }

    #[test]
    fn it_follows_from_its_start() {
        let mut device = Replay::new(line(), DVec3::Y, AtEnd::Hold).unwrap();
        let tool = device.read(1.0).unwrap();
        assert_eq!(tool.position, DVec3::new(0.5, 1.0, 0.0));
        assert_eq!(tool.velocity, DVec3::X * 0.5);
        assert_eq!(device.write(GatedWrench::ZERO, 1e-3), Ok(()));
        assert_eq!(device.read(9.0), Ok(ToolState::at(DVec3::new(1.0, 1.0, 0.0))));
        device.close();
        assert!(device.read(9.0).is_err());
    }

    #[test]
    fn it_repeats_only_what_is_closed() {
        assert!(matches!(Replay::new(line(), DVec3::ZERO, AtEnd::Repeat), Err(DeviceError::Motion(_))));
        assert!(matches!(Replay::new(line(), DVec3::NAN, AtEnd::Hold), Err(DeviceError::Setting(_))));
        let tremor = Motion::builtin("tremor").unwrap();
        let mut device = Replay::new(tremor, DVec3::Y, AtEnd::Repeat).unwrap();
        let (first, again) = (device.read(1.3).unwrap(), device.read(1.3 + 8.0).unwrap());
        assert!((first.position - again.position).length() < 1e-9);
    }
}
