//! 3D Systems' devices (Touch, formerly Phantom Omni), by the library libHD of OpenHaptics.
//!
//! Of its documented C interface (OpenHaptics Toolkit, HDAPI): a scheduler of the library's own calls back a thousand times
//! a second, and only there is the device looked at. Positions in mm, forces in N; x right, y up, z to the user.

use super::library::MakersLibrary;
use crate::{DeviceError, HapticDevice, Pacing};
use glam::DVec3;
use hapflow_haptics::{GatedWrench, ToolState, VelocityEstimator};
use hapflow_realtime::{LatestReader, LatestWriter, latest};
use std::ffi::{c_char, c_int, c_uint, c_ushort, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::ptr::{NonNull, null};

const NAME: &str = "touch";
const FILES: [&str; 4] = ["libHD.so.3.4", "libHD.so", "hd.dll", "HD.dll"];
const REMEDY: &str =
    "install OpenHaptics and the device's driver (3dsystems.com) so that the system finds its library";
const PLUG: &str = "check its cable and supply, and the maker's own diagnostic tool, then open it again";

/// Numbers as in the toolkit's reference.
const INVALID_HANDLE: c_uint = 0xFFFF_FFFF;
const CURRENT_BUTTONS: c_uint = 0x2000;
const CURRENT_POSITION: c_uint = 0x2050;
const CURRENT_FORCE: c_uint = 0x2700;
const FORCE_OUTPUT: c_uint = 0x4000;
const SUCCESS: c_uint = 0;
const CALLBACK_DONE: c_uint = 0;
const CALLBACK_CONTINUE: c_uint = 1;
const DEFAULT_PRIORITY: c_ushort = 0x7FFF;

/// A force that is not renewed for so many callbacks goes.
const SILENT_TICKS: u32 = 20;
/// A device that gives no new state for so long is lost, s.
const LOST_S: f64 = 0.1;

#[repr(C)]
#[derive(Clone, Copy)]
struct ErrorInfo {
    code: c_uint,
    internal: c_int,
    device: c_uint,
}

type Callback = extern "C" fn(*mut c_void) -> c_uint;

/// The functions that are needed.
#[derive(Clone, Copy)]
struct Hd {
    init: unsafe extern "C" fn(*const c_char) -> c_uint,
    disable_device: unsafe extern "C" fn(c_uint),
    enable: unsafe extern "C" fn(c_uint),
    start: unsafe extern "C" fn(),
    stop: unsafe extern "C" fn(),
    schedule: unsafe extern "C" fn(Callback, *mut c_void, c_ushort) -> std::ffi::c_ulong,
    unschedule: unsafe extern "C" fn(std::ffi::c_ulong),
    begin_frame: unsafe extern "C" fn(c_uint),
    end_frame: unsafe extern "C" fn(c_uint),
    get_doubles: unsafe extern "C" fn(c_uint, *mut f64),
    get_integers: unsafe extern "C" fn(c_uint, *mut c_int),
    set_doubles: unsafe extern "C" fn(c_uint, *const f64),
    error: unsafe extern "C" fn() -> ErrorInfo,
}

impl Hd {
    fn load(files: &[&Path]) -> Result<Self, DeviceError> {
        let library = MakersLibrary::load(NAME, files, "its library libHD is not installed", REMEDY)?;
        // SAFETY: the types are those of the toolkit's reference.
        unsafe {
            Ok(Self {
                init: library.function("hdInitDevice")?,
                disable_device: library.function("hdDisableDevice")?,
                enable: library.function("hdEnable")?,
                start: library.function("hdStartScheduler")?,
                stop: library.function("hdStopScheduler")?,
                schedule: library.function("hdScheduleAsynchronous")?,
                unschedule: library.function("hdUnschedule")?,
                begin_frame: library.function("hdBeginFrame")?,
                end_frame: library.function("hdEndFrame")?,
                get_doubles: library.function("hdGetDoublev")?,
                get_integers: library.function("hdGetIntegerv")?,
                set_doubles: library.function("hdSetDoublev")?,
                error: library.function("hdGetError")?,
            })
        }
    }
}

/// What the scheduler's thread saw.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    position: DVec3,
    buttons: u32,
    failed: bool,
}

/// The scheduler's side of the device.
struct Scheduled {
    hd: Hd,
    device: c_uint,
    seen: LatestWriter<Seen>,
    force: LatestReader<DVec3>,
    silent_ticks: u32,
}

impl Scheduled {
    /// One tick of the library's scheduler; false when it is to be the last.
    fn tick(&mut self) -> bool {
        self.silent_ticks = if self.force.update() { 0 } else { self.silent_ticks.saturating_add(1) };
        let force = if self.silent_ticks < SILENT_TICKS { *self.force.get() } else { DVec3::ZERO };
        let (mut position, mut buttons) = ([0.0; 3], 0);
        // SAFETY: the arrays have the three numbers that these parameters have.
        let failed = unsafe {
            (self.hd.begin_frame)(self.device);
            (self.hd.get_doubles)(CURRENT_POSITION, position.as_mut_ptr());
            (self.hd.get_integers)(CURRENT_BUTTONS, &mut buttons);
            (self.hd.set_doubles)(CURRENT_FORCE, force.to_array().as_ptr());
            (self.hd.end_frame)(self.device);
            (self.hd.error)().code != SUCCESS
        };
        let position = DVec3::from_array(position) * 1e-3;
        self.seen.write(Seen { position, buttons: buttons as u32, failed });
        !failed
    }
}

extern "C" fn scheduled(data: *mut c_void) -> c_uint {
    // SAFETY: the pointer is that of the `Scheduled` that was given with it, which lives until the scheduler has stopped;
    // nobody else uses it meanwhile.
    let ticked = catch_unwind(AssertUnwindSafe(|| unsafe { (*data.cast::<Scheduled>()).tick() }));
    if matches!(ticked, Ok(true)) { CALLBACK_CONTINUE } else { CALLBACK_DONE }
}

/// A device of 3D Systems.
pub struct OpenHaptics {
    hd: Hd,
    device: c_uint,
    handle: std::ffi::c_ulong,
    scheduled: NonNull<Scheduled>,
    seen: LatestReader<Seen>,
    force: LatestWriter<DVec3>,
    offset: DVec3,
    velocity: VelocityEstimator,
    /// When there was something new, s.
    newest_s: Option<f64>,
    closed: bool,
}

// SAFETY: the library may be called from any thread; what the pointer names is only freed after its scheduler has stopped.
unsafe impl Send for OpenHaptics {}

impl std::fmt::Debug for OpenHaptics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("OpenHaptics").field("closed", &self.closed).finish_non_exhaustive()
    }
}

impl OpenHaptics {
    /// The maker's default device; `offset` is added to every place, m.
    ///
    /// # Errors
    /// [`DeviceError`] if the library is not installed, or there is no device.
    pub fn open(offset: DVec3) -> Result<Self, DeviceError> {
        Self::open_with(&FILES.map(Path::new), offset)
    }

    /// As [`open`](Self::open), with the library in one of these files.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn open_with(files: &[&Path], offset: DVec3) -> Result<Self, DeviceError> {
        let hd = Hd::load(files)?;
        // SAFETY: null is the default device.
        let (device, error) = unsafe { ((hd.init)(null()), (hd.error)()) };
        if device == INVALID_HANDLE || error.code != SUCCESS {
            let cause = format!("its library reports error {:#06x}", error.code);
            return Err(DeviceError::Refused { device: NAME, cause, remedy: PLUG });
        }
        let (seen_in, seen) = latest(Seen::default());
        let (force, force_out) = latest(DVec3::ZERO);
        let scheduled_side =
            Scheduled { hd, device, seen: seen_in, force: force_out, silent_ticks: SILENT_TICKS };
        let scheduled_side = NonNull::from(Box::leak(Box::new(scheduled_side)));
        // SAFETY: what the callback gets lives until `close`, which stops the scheduler first.
        let handle = unsafe {
            (hd.enable)(FORCE_OUTPUT);
            let handle = (hd.schedule)(scheduled, scheduled_side.as_ptr().cast(), DEFAULT_PRIORITY);
            (hd.start)();
            handle
        };
        let velocity = VelocityEstimator::default();
        Ok(Self {
            hd,
            device,
            handle,
            scheduled: scheduled_side,
            seen,
            force,
            offset,
            velocity,
            newest_s: None,
            closed: false,
        })
    }

    fn lost(cause: &'static str) -> DeviceError {
        DeviceError::Lost { device: NAME, cause, remedy: PLUG }
    }
}

impl HapticDevice for OpenHaptics {
    fn name(&self) -> &str {
        NAME
    }

    fn pacing(&self) -> Pacing {
        Pacing::Timer
    }

    fn read(&mut self, time_s: f64) -> Result<ToolState, DeviceError> {
        DeviceError::if_closed(self.closed, NAME)?;
        let newest_s = *self.newest_s.get_or_insert(time_s);
        if self.seen.update() {
            self.newest_s = Some(time_s);
        } else if time_s - newest_s > LOST_S {
            return Err(Self::lost("it gives no new state"));
        }
        let Seen { position, buttons, failed } = *self.seen.get();
        if failed {
            return Err(Self::lost("its library reports an error"));
        }
        let position = position + self.offset;
        Ok(ToolState { velocity: self.velocity.update(time_s, position), buttons, ..ToolState::at(position) })
    }

    fn write(&mut self, wrench: GatedWrench, _dt_s: f64) -> Result<(), DeviceError> {
        DeviceError::if_closed(self.closed, NAME)?;
        self.force.write(wrench.force());
        Ok(())
    }

    fn close(&mut self) {
        if self.closed {
            return;
        }
        self.closed = true;
        // SAFETY: once the scheduler has stopped nothing is called back, and the callback's side may be freed.
        unsafe {
            (self.hd.stop)();
            (self.hd.unschedule)(self.handle);
            // The library leaves the last force standing.
            (self.hd.begin_frame)(self.device);
            (self.hd.set_doubles)(CURRENT_FORCE, [0.0; 3].as_ptr());
            (self.hd.end_frame)(self.device);
            (self.hd.disable_device)(self.device);
            drop(Box::from_raw(self.scheduled.as_ptr()));
        }
    }
}

impl Drop for OpenHaptics {
    fn drop(&mut self) {
        self.close();
    }
}
