//! The functions of a device that the host drives in a loop of its own.

use crate::caller::{In, Out};
use crate::code::{Code, Failure, Outcome};
use crate::device_config::DeviceConfig;
use crate::device_table::DEVICES;
use crate::fence::{fence, fence_main};
use crate::handle::DeviceHandle;
use crate::hooks;
use crate::servo::remark;
use crate::session::open_ready;
use crate::table::LIBRARY;
use crate::tool_state::{ToolStateRecord, check_dt, check_time};
use crate::wrench::WrenchRecord;
use hapflow_devices::HapticDevice;
use hapflow_engine::{Scene, SceneError};
use hapflow_haptics::{FaultSet, GatedWrench, ModelAge, SafetyGate, ToolState, Wrench};
use hapflow_realtime::{Faultable, SharedFlags};

/// Time since the last reading, as the first one has it, s.
const FIRST_DT_S: f64 = 1e-3;

/// Takes devices of the host for a session: all of these, or none.
pub fn take_over(handles: &[DeviceHandle]) -> Result<Vec<Box<dyn HapticDevice>>, Failure> {
    Ok(DEVICES.take(handles)?.into_iter().map(DeviceSide::into_device).collect())
}

/// A device, with a gate of its own.
pub struct DeviceSide {
    device: Box<dyn HapticDevice>,
    gate: SafetyGate,
    /// Faults that the next write latches.
    found: FaultSet,
    clear: SharedFlags,
    last_s: Option<f64>,
}

impl Faultable for DeviceSide {
    fn fault(&mut self) {
        self.found |= FaultSet::PANIC;
    }
}

impl DeviceSide {
    fn open(scene: &Scene) -> Result<Self, Failure> {
        let (device, gate) = (open_ready(scene)?, SafetyGate::new(scene.gate).map_err(SceneError::from)?);
        Ok(Self { device, gate, found: FaultSet::NONE, clear: SharedFlags::new(), last_s: None })
    }

    /// Raised by any thread to clear the faults.
    pub fn clear_flag(&self) -> SharedFlags {
        self.clear.clone()
    }

    /// The device, without force, for a session.
    fn into_device(mut self) -> Box<dyn HapticDevice> {
        // One that is lost says so to the session, too.
        let _ = self.device.write(GatedWrench::ZERO, FIRST_DT_S);
        self.device
    }

    /// Its state, and the time since the last one.
    fn read(&mut self, time_s: f64) -> Result<(ToolState, f64), Code> {
        check_time(time_s)?;
        let dt_s = self.last_s.map_or(FIRST_DT_S, |last| time_s - last);
        if dt_s < 0.0 {
            return Err(Code::ERROR_TIME);
        }
        let state = self.device.read(time_s).ok().filter(ToolState::is_finite);
        self.last_s = Some(time_s);
        state.map(|s| (s, dt_s)).ok_or_else(|| {
            let _ = self.device.write(GatedWrench::ZERO, dt_s);
            self.lose()
        })
    }

    fn lose(&mut self) -> Code {
        self.found |= FaultSet::DEVICE_LOST;
        Code::ERROR_DEVICE
    }

    /// What is refused reaches the device as no force, and latches.
    fn write(&mut self, wrench: Result<Wrench, Code>, dt_s: f64) -> Outcome {
        self.take_clear();
        let checked = wrench.and_then(|w| checked(w, dt_s));
        if checked.is_err() {
            self.found |= FaultSet::NON_FINITE_INPUT;
        }
        let (wanted, dt_s) = checked.map_or((Wrench::ZERO, 0.0), |w| (w, dt_s));
        let found = std::mem::take(&mut self.found);
        let passed = self.gate.pass(wanted, &ModelAge::FRESH, found, dt_s);
        let sent = if wanted == Wrench::ZERO { self.gate.release() } else { passed };
        let written = self.device.write(sent, dt_s);
        checked?;
        written.map_err(|_| self.lose())?;
        Ok(remark(self.gate.faults(), dt_s))
    }

    fn take_clear(&mut self) {
        if self.clear.clear(u32::MAX) != 0 {
            self.gate.clear_faults(std::mem::take(&mut self.found));
        }
    }
}

fn checked(wrench: Wrench, dt_s: f64) -> Result<Wrench, Code> {
    check_dt(dt_s)?;
    if wrench.is_finite() { Ok(wrench) } else { Err(Code::ERROR_NOT_FINITE) }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_config_init(config: Out<DeviceConfig>, size: u32) -> Code {
    fence(|| config.init(&DeviceConfig::DEFAULT, size).map(|()| Code::OK))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_open(config: In<DeviceConfig>, device: Out<DeviceHandle>) -> Code {
    fence_main(|| {
        LIBRARY.negotiated()?;
        device.check()?;
        let config = config.read(DeviceConfig::DEFAULT)?;
        config.check()?;
        hooks::panic_if_asked();
        device.put(DEVICES.place(|| DeviceSide::open(&config.scene()?))?)?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_close(device: DeviceHandle) -> Code {
    fence_main(|| {
        DEVICES.claim(device)?.take()?.into_device().close();
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_read(
    device: DeviceHandle,
    time_s: f64,
    state: Out<ToolStateRecord>,
) -> Code {
    fence(|| {
        let mut side = DEVICES.enter(device)?;
        let then = state.current(ToolStateRecord::DEFAULT)?;
        hooks::panic_if_asked();
        let (now, dt_s) = side.read(time_s)?;
        state.fill(&then.measured(&now, time_s, dt_s))?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_write(device: DeviceHandle, wrench: In<WrenchRecord>, dt_s: f64) -> Code {
    fence(|| {
        let mut side = DEVICES.enter(device)?;
        hooks::panic_if_asked();
        side.write(wrench.whole().map(Wrench::from), dt_s)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_clear_faults(device: DeviceHandle) -> Code {
    fence(|| {
        DEVICES.clear(device)?.raise(1);
        Ok(Code::OK)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use hapflow_devices::{DeviceError, Pacing};
    use hapflow_haptics::GateSettings;
    use std::sync::{Arc, Mutex};

    /// Keeps what was written, and fails or answers nonsense when told.
    struct Fake {
        written: Arc<Mutex<Vec<Wrench>>>,
        lost_at_s: f64,
        nonsense_at_s: f64,
    }

    impl HapticDevice for Fake {
        fn name(&self) -> &str {
            "fake"
        }
        fn pacing(&self) -> Pacing {
            Pacing::Timer
        }
        fn read(&mut self, time_s: f64) -> Result<ToolState, DeviceError> {
            if time_s >= self.lost_at_s {
                return Err(DeviceError::Closed { device: "fake" });
            }
            let x = if time_s >= self.nonsense_at_s { f64::NAN } else { time_s };
            Ok(ToolState::at(DVec3::X * x))
        }
        fn write(&mut self, wrench: GatedWrench, _: f64) -> Result<(), DeviceError> {
            self.written.lock().unwrap().push(wrench.wrench());
            Ok(())
        }
        fn close(&mut self) {}
    }

    struct Held {
        side: DeviceSide,
        written: Arc<Mutex<Vec<Wrench>>>,
    }

    impl Held {
        fn new(lost_at_s: f64, nonsense_at_s: f64) -> Self {
            let written = Arc::default();
            let device = Box::new(Fake { written: Arc::clone(&written), lost_at_s, nonsense_at_s });
            let gate = SafetyGate::new(GateSettings { ramp_in_s: 0.0, ..GateSettings::default() }).unwrap();
            let (found, clear) = (FaultSet::NONE, SharedFlags::new());
            Self { side: DeviceSide { device, gate, found, clear, last_s: None }, written }
        }

        /// Writes along x for a millisecond, and says what the device got.
        fn write(&mut self, x: f64) -> (Code, f64) {
            let result = self.side.write(Ok(Wrench::from_force(DVec3::X * x)), 1e-3);
            (result.unwrap(), self.newest())
        }

        fn newest(&self) -> f64 {
            self.written.lock().unwrap().last().unwrap().force.x
        }
    }

    #[test]
    fn a_write_is_limited_and_zeros_act_at_once() {
        let mut held = Held::new(9.0, 9.0);
        let rising: Vec<_> = (0..6).map(|_| held.write(100.0).1).collect();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(rising.iter().zip([1.0, 2.0, 3.0, 4.0, 4.0, 4.0]).all(|(a, b)| near(*a, b)), "{rising:?}");
        assert_eq!(held.write(0.0), (Code::OK, 0.0));
        assert!(near(held.write(100.0).1, 1.0), "from zero again");
    }

    #[test]
    fn what_is_refused_is_no_force_and_latches_until_cleared() {
        let null = Err(Code::ERROR_NULL);
        let (good, nan) = (Wrench::from_force(DVec3::X), Wrench::from_force(DVec3::X * f64::NAN));
        for (wrench, dt_s, code) in [
            (null, 1e-3, Code::ERROR_NULL),
            (Ok(nan), 1e-3, Code::ERROR_NOT_FINITE),
            (Ok(good), f64::NAN, Code::ERROR_NOT_FINITE),
            (Ok(good), -1e-3, Code::ERROR_TIME),
        ] {
            let mut held = Held::new(9.0, 9.0);
            held.write(1.0);
            assert_eq!(held.side.write(wrench, dt_s), Err(code));
            assert_eq!(held.newest(), 0.0);
            assert_eq!(held.write(1.0), (Code::REMARK_FORCE_HELD, 0.0));
            held.side.clear_flag().raise(1);
            assert!(held.write(1.0).1 > 0.9);
        }
    }

    #[test]
    fn a_device_that_is_lost_or_answers_nonsense_has_no_force() {
        for (lost, nonsense) in [(0.5, 9.0), (9.0, 0.5)] {
            let mut held = Held::new(lost, nonsense);
            let (state, dt_s) = held.side.read(0.25).unwrap();
            assert_eq!((state.position.x, dt_s), (0.25, FIRST_DT_S));
            assert_eq!(held.side.read(0.375).unwrap().1, 0.125);
            assert_eq!(held.side.read(0.25).unwrap_err(), Code::ERROR_TIME);
            held.write(1.0);
            assert_eq!(held.side.read(0.5).unwrap_err(), Code::ERROR_DEVICE);
            assert_eq!(held.newest(), 0.0);
            assert_eq!(held.write(1.0), (Code::REMARK_FORCE_HELD, 0.0));
        }
    }

    #[test]
    fn a_session_gets_it_without_force() {
        let mut held = Held::new(9.0, 9.0);
        held.write(1.0);
        let written = Arc::clone(&held.written);
        drop(held.side.into_device());
        assert_eq!(written.lock().unwrap().last(), Some(&Wrench::ZERO));
    }

    #[test]
    fn a_panic_inside_latches() {
        let mut held = Held::new(9.0, 9.0);
        held.side.fault();
        assert_eq!(held.write(1.0), (Code::REMARK_FORCE_HELD, 0.0));
    }
}
