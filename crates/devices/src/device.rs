//! What every haptic device can do.

use crate::DeviceError;
use hapflow_haptics::{GatedWrench, ToolState};
use std::ops::ControlFlow;

/// Who sets the pace of the servo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pacing {
    /// A timer: reading and writing return at once.
    Timer,
    /// The device: one of reading and writing waits for its transfer, and no timer may run beside it.
    Device,
}

/// A device that a hand holds. One thread uses it at a time: the servo's. A tick reads, computes, writes.
///
/// Poses and wrenches are in the device frame: metres, newtons, right-handed, y up. Reading and writing must
/// not allocate, lock or log, and make no system call but the device's own transfer.
pub trait HapticDevice: Send {
    /// Its name, as in [`list`](crate::list).
    fn name(&self) -> &str;

    /// Who sets the pace of the servo.
    fn pacing(&self) -> Pacing;

    /// Brings the device to where it can be read and give force, with a person's help where it needs that: `tell` gets a
    /// line for that person, again and again while there is something to do, and may break it off. Thread: main, before
    /// the first read; may take as long as the person does. Most devices are ready at once.
    ///
    /// # Errors
    /// [`DeviceError`] if it cannot be brought there, or was broken off.
    fn prepare(&mut self, tell: &mut dyn FnMut(&str) -> ControlFlow<()>) -> Result<(), DeviceError> {
        let _ = tell;
        Ok(())
    }

    /// Pose and motion at `time_s`, the session's time, s, which never goes back. Simulated devices move up
    /// to that time; real ones give their newest state.
    ///
    /// # Errors
    /// [`DeviceError`] if the device does not answer. The caller then sends no force until a person has seen
    /// to it.
    fn read(&mut self, time_s: f64) -> Result<ToolState, DeviceError>;

    /// The wrench that the hand feels until the next one; `dt_s` is the time since the last tick, s. Axes
    /// that the device cannot drive are ignored.
    ///
    /// # Errors
    /// [`DeviceError`] if the device does not answer.
    fn write(&mut self, wrench: GatedWrench, dt_s: f64) -> Result<(), DeviceError>;

    /// Takes every force off and lets go of the device. May be called twice; reading and writing afterwards
    /// is [`DeviceError::Closed`].
    fn close(&mut self);
}
