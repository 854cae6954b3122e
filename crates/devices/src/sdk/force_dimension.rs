//! Force Dimension's devices (omega, delta, sigma, and on Windows the Falcon), by their library libdhd.
//!
//! Of its documented C interface (Force Dimension SDK, "DHD"): positions in m, forces in N; its x points to the user, y to
//! the right, z up.

use super::library::MakersLibrary;
use crate::{DeviceError, HapticDevice, Pacing};
use glam::DVec3;
use hapflow_haptics::{GatedWrench, ToolState, VelocityEstimator};
use std::ffi::{CStr, c_char, c_int, c_uchar, c_uint};
use std::path::Path;

const NAME: &str = "force-dimension";
const FILES: [&str; 5] = ["libdhd.so.3", "libdhd.so", "libdhd.dylib", "dhd64.dll", "dhd.dll"];
const REMEDY: &str =
    "install the Force Dimension SDK (forcedimension.com) so that the system finds its library";
const PLUG: &str = "check its cable and supply, then open it again";
/// The force goes if none was sent for so many times 125 µs: 20 ms.
const WATCHDOG: c_uchar = 160;

/// The functions that are needed.
#[derive(Clone, Copy)]
struct Dhd {
    device_count: unsafe extern "C" fn() -> c_int,
    open: unsafe extern "C" fn() -> c_int,
    close: unsafe extern "C" fn(c_char) -> c_int,
    enable_force: unsafe extern "C" fn(c_uchar, c_char) -> c_int,
    position: unsafe extern "C" fn(*mut f64, *mut f64, *mut f64, c_char) -> c_int,
    set_force: unsafe extern "C" fn(f64, f64, f64, c_char) -> c_int,
    button_mask: unsafe extern "C" fn(c_char) -> c_uint,
    last_error: unsafe extern "C" fn() -> *const c_char,
    /// Newer versions only.
    set_watchdog: Option<unsafe extern "C" fn(c_uchar, c_char) -> c_int>,
}

impl Dhd {
    fn load(files: &[&Path]) -> Result<Self, DeviceError> {
        let library = MakersLibrary::load(NAME, files, "its library libdhd is not installed", REMEDY)?;
        // SAFETY: the types are those of the library's documentation.
        unsafe {
            Ok(Self {
                device_count: library.function("dhdGetDeviceCount")?,
                open: library.function("dhdOpen")?,
                close: library.function("dhdClose")?,
                enable_force: library.function("dhdEnableForce")?,
                position: library.function("dhdGetPosition")?,
                set_force: library.function("dhdSetForce")?,
                button_mask: library.function("dhdGetButtonMask")?,
                last_error: library.function("dhdErrorGetLastStr")?,
                set_watchdog: library.function("dhdSetWatchdog").ok(),
            })
        }
    }

    fn last_error(&self) -> String {
        // SAFETY: the library gives null or a text of its own.
        unsafe {
            let text = (self.last_error)();
            if text.is_null() {
                "for no reason it tells".into()
            } else {
                CStr::from_ptr(text).to_string_lossy().into_owned()
            }
        }
    }
}

/// A device of Force Dimension.
pub struct ForceDimension {
    dhd: Dhd,
    id: c_char,
    offset: DVec3,
    velocity: VelocityEstimator,
    closed: bool,
}

impl std::fmt::Debug for ForceDimension {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ForceDimension").field("closed", &self.closed).finish_non_exhaustive()
    }
}

impl ForceDimension {
    /// Whether there is one: how many are plugged in. Thread: main.
    ///
    /// # Errors
    /// [`DeviceError::Unavailable`] if the library is not installed.
    pub fn count() -> Result<u32, DeviceError> {
        let dhd = Dhd::load(&FILES.map(Path::new))?;
        // SAFETY: the call has no arguments.
        Ok(u32::try_from(unsafe { (dhd.device_count)() }).unwrap_or(0))
    }

    /// The first device; `offset` is added to every place, m.
    ///
    /// # Errors
    /// [`DeviceError`] if the library is not installed, or there is no device.
    pub fn open(offset: DVec3) -> Result<Self, DeviceError> {
        Self::open_with(&FILES.map(Path::new), offset)
    }

    /// The same, with the library in one of these files.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn open_with(files: &[&Path], offset: DVec3) -> Result<Self, DeviceError> {
        let dhd = Dhd::load(files)?;
        // SAFETY: the calls have no pointers.
        let id = unsafe { if (dhd.device_count)() > 0 { (dhd.open)() } else { -1 } };
        let refused = |cause| DeviceError::Refused { device: NAME, cause, remedy: PLUG };
        let id = c_char::try_from(id).ok().filter(|id| *id >= 0).ok_or_else(|| refused(dhd.last_error()))?;
        let mut device = Self { dhd, id, offset, velocity: VelocityEstimator::default(), closed: false };
        // Nothing is left of another program's force when the motors come on.
        device.set_force(DVec3::ZERO)?;
        // SAFETY: the calls have no pointers.
        unsafe {
            if let Some(set_watchdog) = device.dhd.set_watchdog {
                set_watchdog(WATCHDOG, id);
            }
            if (device.dhd.enable_force)(1, id) < 0 {
                return Err(refused(device.dhd.last_error()));
            }
        }
        Ok(device)
    }

    fn set_force(&mut self, force: DVec3) -> Result<(), DeviceError> {
        // SAFETY: the call has no pointers. Its x is our z, its y our x, its z our y.
        let result = unsafe { (self.dhd.set_force)(force.z, force.x, force.y, self.id) };
        // Positive results are remarks.
        if result < 0 { Err(self.lost()) } else { Ok(()) }
    }

    fn lost(&self) -> DeviceError {
        DeviceError::Lost { device: NAME, cause: "its library reports an error", remedy: PLUG }
    }
}

impl HapticDevice for ForceDimension {
    fn name(&self) -> &str {
        NAME
    }

    fn pacing(&self) -> Pacing {
        Pacing::Timer
    }

    fn read(&mut self, time_s: f64) -> Result<ToolState, DeviceError> {
        DeviceError::if_closed(self.closed, NAME)?;
        let (mut to_user, mut right, mut up) = (0.0, 0.0, 0.0);
        // SAFETY: three numbers to write to.
        let result = unsafe { (self.dhd.position)(&mut to_user, &mut right, &mut up, self.id) };
        if result < 0 {
            return Err(self.lost());
        }
        let position = DVec3::new(right, up, to_user) + self.offset;
        let velocity = self.velocity.update(time_s, position);
        // SAFETY: the call has no pointers.
        let buttons = unsafe { (self.dhd.button_mask)(self.id) };
        Ok(ToolState { velocity, buttons, ..ToolState::at(position) })
    }

    fn write(&mut self, wrench: GatedWrench, _dt_s: f64) -> Result<(), DeviceError> {
        DeviceError::if_closed(self.closed, NAME)?;
        let force = wrench.force();
        self.set_force(force)
    }

    fn close(&mut self) {
        if self.closed {
            return;
        }
        self.closed = true;
        let _ = self.set_force(DVec3::ZERO);
        // SAFETY: the calls have no pointers.
        unsafe {
            (self.dhd.enable_force)(0, self.id);
            (self.dhd.close)(self.id);
        }
    }
}

impl Drop for ForceDimension {
    fn drop(&mut self) {
        self.close();
    }
}
