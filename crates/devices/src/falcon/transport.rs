//! The way to a serial chip over USB, real or emulated.

use crate::falcon::FalconError;

/// A Falcon that is plugged in.
#[derive(Clone, Debug, PartialEq)]
pub struct PluggedIn {
    /// USB bus.
    pub bus: u8,
    /// Address on it.
    pub address: u8,
    /// Its serial number, or why it cannot be had.
    pub serial: Result<String, FalconError>,
}

/// Bytes of a full-speed bulk packet.
pub const USB_PACKET_BYTES: usize = 64;

/// What a transfer came to that failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// The device is not there any more.
    #[error("it was unplugged")]
    Unplugged,
    /// The device refused the transfer.
    #[error("it refused a transfer (stall)")]
    Stalled,
    /// The transfer was not done in time.
    #[error("a transfer took too long")]
    TimedOut,
    /// Something else.
    #[error("{0}")]
    Other(&'static str),
}

/// USB transfers to one serial chip, interface 0, bulk endpoints 0x81 and 0x02. One thread uses it at a time. Reading
/// and writing allocate and lock nothing of their own; libusb takes a few bytes and its own uncontended locks for a transfer.
pub trait Transport: Send {
    /// The time, ns, on a clock that never goes back.
    fn now_ns(&self) -> u64;

    /// A vendor request to the chip, without data.
    ///
    /// # Errors
    /// [`LinkError`] if it does not get there.
    fn control(&mut self, request: u8, value: u16) -> Result<(), LinkError>;

    /// Bits of the modem status: CTS is 0x10.
    ///
    /// # Errors
    /// [`LinkError`] if there is no answer.
    fn modem_status(&mut self) -> Result<u8, LinkError>;

    /// Sends bytes; returns once they are on their way.
    ///
    /// # Errors
    /// [`LinkError`] if they, or earlier ones, do not get there.
    fn write(&mut self, bytes: &[u8]) -> Result<(), LinkError>;

    /// The next IN packet, its two status bytes first, and its length; 0 if none comes until `deadline_ns`.
    ///
    /// # Errors
    /// [`LinkError`] if none can come.
    fn read(&mut self, packet: &mut [u8; USB_PACKET_BYTES], deadline_ns: u64) -> Result<usize, LinkError>;

    /// Lets go of the device and takes it anew, which helps where its start got stuck.
    ///
    /// # Errors
    /// [`LinkError`] if it cannot be had.
    fn reopen(&mut self) -> Result<(), LinkError>;

    /// Waits for what is on its way, and lets go of the device. May be called twice.
    fn close(&mut self);
}
