//! The threads that a session owns, in real time.

use crate::SceneError;
use crate::fluid_unit::FluidUnit;
use crate::servo::ServoUnit;
use crate::tick_times::TickTimes;
use hapflow_devices::{DeviceError, HapticDevice, Pacing};
use hapflow_haptics::{FaultSet, GatedWrench};
use hapflow_realtime::{
    Clock, Grant, HostClock, LatestReader, LatestWriter, RealtimeStatus, RealtimeThread, latest,
    set_normal_priority, spawn_realtime,
};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

/// The servo's period, ns.
const TICK_NS: u64 = 1_000_000;
/// Priority of the servo thread, SCHED_FIFO.
pub const SERVO_PRIORITY: u8 = 80;
/// Ticks after which main sees their times anew.
const TELL_TICKS: u64 = 64;

/// How an owned servo keeps time.
#[derive(Clone, Debug)]
pub struct ServoPace {
    /// What the system said to its priority.
    pub priority: Grant,
    /// Whether it still ticks; it ends by itself when its device is lost, or in a panic.
    pub runs: bool,
    /// Its ticks so far; they lag by up to 64 ticks.
    pub ticks: TickTimes,
}

/// The servo's thread: it owns the device, and paces itself at 1 kHz where the device does not.
pub struct ServoThread {
    stop: Arc<AtomicBool>,
    thread: Option<RealtimeThread<Option<DeviceError>>>,
    status: RealtimeStatus,
    times: LatestReader<TickTimes>,
}

impl std::fmt::Debug for ServoThread {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ServoThread").field("status", &self.status).finish_non_exhaustive()
    }
}

impl ServoThread {
    pub(crate) fn start(
        servo: ServoUnit,
        device: Box<dyn HapticDevice>,
        clock: Arc<dyn Clock>,
    ) -> Result<Self, SceneError> {
        let stop = Arc::new(AtomicBool::new(false));
        let theirs = Arc::clone(&stop);
        let (tell, times) = latest(TickTimes::default());
        let thread = spawn_realtime("hapflow-servo", SERVO_PRIORITY, move || {
            servo_loop(servo, device, &*clock, &theirs, tell)
        })
        .map_err(|cause| SceneError::Thread { name: "servo", cause })?;
        let status = thread.status().clone();
        Ok(Self { stop, thread: Some(thread), status, times })
    }

    /// What the system granted.
    pub fn status(&self) -> RealtimeStatus {
        self.status.clone()
    }

    /// Whether it has ended, as it does when its device is lost.
    pub fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(RealtimeThread::is_finished)
    }

    /// How it keeps time.
    pub fn pace(&mut self) -> ServoPace {
        let (priority, runs) = (self.status.priority.clone(), !self.is_finished());
        self.times.update();
        ServoPace { priority, runs, ticks: self.times.get().clone() }
    }

    /// Stops it, with zero force, and gives its ticks' times, and why its device was lost, if it was.
    pub fn stop(&mut self) -> (TickTimes, Option<DeviceError>) {
        self.stop.store(true, Ordering::Release);
        let ended = self.thread.take().map(RealtimeThread::join);
        (self.pace().ticks, ended.and_then(Result::ok).flatten())
    }
}

impl Drop for ServoThread {
    fn drop(&mut self) {
        self.stop();
    }
}

/// Ticks until it is to stop, or the device is lost, and says why it was.
fn servo_loop(
    mut servo: ServoUnit,
    mut device: Box<dyn HapticDevice>,
    clock: &dyn Clock,
    stop: &AtomicBool,
    mut tell: LatestWriter<TickTimes>,
) -> Option<DeviceError> {
    let mut times = TickTimes::default();
    let timed = device.pacing() == Pacing::Timer;
    let mut last = clock.now_ns();
    let mut due = last + TICK_NS;
    let mut ticks = 0_u64;
    let mut lost = None;
    while !stop.load(Ordering::Acquire) {
        if timed {
            clock.wait_until_ns(due);
        }
        let now = match catch_unwind(AssertUnwindSafe(|| tick(&mut servo, &mut *device, clock, last))) {
            Ok(Ok(now)) => now,
            ended => {
                // A panic or a lost device: zero force, and no tick again.
                servo.raise(if ended.is_ok() { FaultSet::DEVICE_LOST } else { FaultSet::PANIC });
                lost = ended.ok().and_then(Result::err);
                break;
            }
        };
        let late = now.saturating_sub(due);
        times.late += u64::from(late > TICK_NS / 2);
        times.add(clock.now_ns() - now);
        ticks += 1;
        if ticks.is_multiple_of(TELL_TICKS) {
            tell_times(&mut tell, &times);
        }
        last = now;
        // Ticks that were missed are not made up for; and those of a device come when it says.
        due = if timed && late <= TICK_NS { due + TICK_NS } else { now + TICK_NS };
    }
    let _ = catch_unwind(AssertUnwindSafe(|| {
        let _ = device.write(GatedWrench::ZERO, 1e-3);
        device.close();
    }));
    tell_times(&mut tell, &times);
    lost
}

fn tell_times(tell: &mut LatestWriter<TickTimes>, times: &TickTimes) {
    tell.buffer().copy_from(times);
    tell.publish();
}

/// One tick with the device, and its time, ns.
fn tick(
    servo: &mut ServoUnit,
    device: &mut dyn HapticDevice,
    clock: &dyn Clock,
    last: u64,
) -> Result<u64, DeviceError> {
    let seconds = |ns: u64| ns as f64 * 1e-9;
    let asked = clock.now_ns();
    let state = device.read(seconds(asked))?;
    // A device that sets the pace has waited for its state.
    let now = if device.pacing() == Pacing::Device { clock.now_ns() } else { asked };
    let dt_s = seconds(now.saturating_sub(last));
    let wrench = servo.tick(&state, seconds(now), dt_s);
    device.write(wrench, dt_s)?;
    Ok(now)
}

/// How the fluid keeps up with the clock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FluidPace {
    /// Frames that were stepped.
    pub frames: u64,
    /// Frames that the fluid was too slow for.
    pub skipped: u64,
}

/// The fluid's thread: one frame each period.
pub struct FluidThread {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
    pace: LatestReader<FluidPace>,
    /// The host's clock, if it keeps that: closed at the end, or the thread would wait for a tick.
    host: Option<Arc<HostClock>>,
}

impl FluidThread {
    pub(crate) fn start(
        fluid: FluidUnit,
        clock: Arc<dyn Clock>,
        host: Option<Arc<HostClock>>,
    ) -> Result<Self, SceneError> {
        let stop = Arc::new(AtomicBool::new(false));
        let theirs = Arc::clone(&stop);
        let (writer, pace) = latest(FluidPace::default());
        let thread = std::thread::Builder::new()
            .name("hapflow-fluid".into())
            .spawn(move || fluid_thread(fluid, &*clock, &theirs, writer))
            .map_err(|cause| SceneError::Thread { name: "fluid", cause })?;
        Ok(Self { stop, thread: Some(thread), pace, host })
    }

    /// How it keeps up so far.
    pub fn pace(&mut self) -> FluidPace {
        self.pace.update();
        *self.pace.get()
    }

    /// Stops it after its frame, and says how it kept up.
    pub fn stop(&mut self) -> FluidPace {
        self.stop.store(true, Ordering::Release);
        if let Some(clock) = &self.host {
            clock.close();
        }
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
        self.pace()
    }
}

impl Drop for FluidThread {
    fn drop(&mut self) {
        self.stop();
    }
}

fn fluid_thread(mut fluid: FluidUnit, clock: &dyn Clock, stop: &AtomicBool, pace: LatestWriter<FluidPace>) {
    // A host's real-time thread may have opened the session: the fluid must not take its priority.
    let _ = set_normal_priority();
    let flags = fluid.flags.clone();
    let ended = catch_unwind(AssertUnwindSafe(|| fluid_loop(&mut fluid, clock, stop, pace)));
    if ended.is_err() {
        flags.raise(FaultSet::FLUID_FAULT.bits());
    }
}

fn fluid_loop(
    fluid: &mut FluidUnit,
    clock: &dyn Clock,
    stop: &AtomicBool,
    mut pace: LatestWriter<FluidPace>,
) {
    let period = (fluid.frame_s() * 1e9) as u64;
    let mut so_far = FluidPace::default();
    let mut end = clock.now_ns() + period;
    while !stop.load(Ordering::Acquire) {
        clock.wait_until_ns(end);
        if stop.load(Ordering::Acquire) {
            return;
        }
        fluid.compute(end as f64 * 1e-9);
        let now = clock.now_ns();
        fluid.publish(now as f64 * 1e-9);
        so_far.frames += 1;
        end += period;
        // Too slow: fluid time falls behind, and the path between is passed over.
        let behind = now.saturating_sub(end) / period;
        so_far.skipped += behind;
        end += behind * period;
        pace.write(so_far);
    }
}
