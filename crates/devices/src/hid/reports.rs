//! Where a cap's reports come from.

/// The device is gone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the device is gone")]
pub struct Gone;

/// The reports of one device: those of the system, or a test's.
pub trait Reports: Send {
    /// Copies the next report that has come, and gives its length; 0 if none has. Does not wait. Thread: servo.
    ///
    /// # Errors
    /// [`Gone`] if the device does not answer any more.
    fn next(&mut self, report: &mut [u8]) -> Result<usize, Gone>;
}
