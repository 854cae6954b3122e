//! One bulk transfer that is queued, and its buffer. The only unsafe code of the USB transport.
#![allow(unsafe_code)]

use crate::falcon::USB_PACKET_BYTES;
use rusb::constants::{
    LIBUSB_TRANSFER_COMPLETED, LIBUSB_TRANSFER_NO_DEVICE, LIBUSB_TRANSFER_STALL, LIBUSB_TRANSFER_TIMED_OUT,
};
use rusb::ffi;
use rusb::{Context, DeviceHandle, UsbContext};
use std::ffi::c_int;
use std::ptr::NonNull;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How a transfer ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Well.
    Done,
    /// The endpoint refused it.
    Stalled,
    /// It took too long.
    TimedOut,
    /// The device is gone.
    Unplugged,
    /// Otherwise.
    Failed,
}

/// What libusb writes to while the transfer is under way.
struct Shared {
    buffer: [u8; USB_PACKET_BYTES],
    under_way: AtomicBool,
}

/// A bulk transfer of one packet, made once and submitted again and again.
pub struct Transfer {
    transfer: NonNull<ffi::libusb_transfer>,
    shared: NonNull<Shared>,
}

// SAFETY: libusb may be called from any thread; what the pointers name belongs to this transfer alone, and the callback
// only sets an atomic.
unsafe impl Send for Transfer {}

/// Called by libusb, within `handle_events`, once a transfer has ended.
extern "system" fn ended(transfer: *mut ffi::libusb_transfer) {
    // SAFETY: libusb passes the transfer that was submitted, whose user data is its `Shared`; both outlive it, since a
    // `Transfer` that is under way is never freed.
    let shared = unsafe { &*(*transfer).user_data.cast::<Shared>() };
    shared.under_way.store(false, Ordering::Release);
}

impl Transfer {
    /// A transfer on `endpoint`, which is given up after `timeout_ms`; 0 is never. Nothing if there is no memory.
    pub fn new(handle: &DeviceHandle<Context>, endpoint: u8, timeout_ms: u32) -> Option<Self> {
        let shared = Box::new(Shared { buffer: [0; USB_PACKET_BYTES], under_way: AtomicBool::new(false) });
        // SAFETY: no isochronous packets are asked for; null is refused here.
        let transfer = NonNull::new(unsafe { ffi::libusb_alloc_transfer(0) })?;
        let shared = NonNull::from(Box::leak(shared));
        // SAFETY: the transfer was just made; handle and buffer are valid, and `submit` is only called while they are.
        unsafe {
            let buffer = (&raw mut (*shared.as_ptr()).buffer).cast();
            let (length, data) = (USB_PACKET_BYTES as c_int, shared.as_ptr().cast());
            let raw = handle.as_raw();
            ffi::libusb_fill_bulk_transfer(
                transfer.as_ptr(),
                raw,
                endpoint,
                buffer,
                length,
                ended,
                data,
                timeout_ms,
            );
        }
        Some(Self { transfer, shared })
    }

    /// Whether libusb has it.
    pub fn is_under_way(&self) -> bool {
        // SAFETY: `shared` is valid for as long as this is; the flag is atomic.
        unsafe { (*self.shared.as_ptr()).under_way.load(Ordering::Acquire) }
    }

    /// Sends `bytes`, at most a packet; for a transfer to the device that is not under way.
    pub fn send(&mut self, bytes: &[u8]) -> rusb::Result<()> {
        let len = bytes.len().min(USB_PACKET_BYTES);
        if self.is_under_way() {
            return Err(rusb::Error::Busy);
        }
        // SAFETY: it is not under way, so that nobody else uses buffer or transfer.
        unsafe {
            let buffer = &mut (*self.shared.as_ptr()).buffer;
            buffer[..len].copy_from_slice(&bytes[..len]);
            (*self.transfer.as_ptr()).length = len as c_int;
        }
        self.submit()
    }

    /// Hands it to libusb; for one that is not under way.
    pub fn submit(&mut self) -> rusb::Result<()> {
        // SAFETY: both are valid; a transfer that is under way already is refused by libusb.
        let code = unsafe {
            (*self.shared.as_ptr()).under_way.store(true, Ordering::Release);
            ffi::libusb_submit_transfer(self.transfer.as_ptr())
        };
        if code == 0 {
            return Ok(());
        }
        // SAFETY: as above.
        unsafe { (*self.shared.as_ptr()).under_way.store(false, Ordering::Release) };
        Err(error(code))
    }

    /// Asks libusb to give it back early.
    pub fn cancel(&mut self) {
        // SAFETY: the transfer is valid; one that is not under way is refused.
        unsafe { ffi::libusb_cancel_transfer(self.transfer.as_ptr()) };
    }

    /// How it ended; for one that is not under way.
    pub fn ended(&self) -> Ended {
        // SAFETY: it is not under way, so that libusb does not write to it.
        match unsafe { (*self.transfer.as_ptr()).status } {
            LIBUSB_TRANSFER_COMPLETED => Ended::Done,
            LIBUSB_TRANSFER_STALL => Ended::Stalled,
            LIBUSB_TRANSFER_TIMED_OUT => Ended::TimedOut,
            LIBUSB_TRANSFER_NO_DEVICE => Ended::Unplugged,
            _ => Ended::Failed,
        }
    }

    /// Copies what came, and says how much; for one that is not under way.
    pub fn take(&self, packet: &mut [u8; USB_PACKET_BYTES]) -> usize {
        // SAFETY: it is not under way, so that nobody writes to buffer or transfer.
        unsafe {
            *packet = (*self.shared.as_ptr()).buffer;
            usize::try_from((*self.transfer.as_ptr()).actual_length).unwrap_or(0).min(USB_PACKET_BYTES)
        }
    }
}

impl Drop for Transfer {
    fn drop(&mut self) {
        if self.is_under_way() {
            // libusb still has it: better a few bytes lost than written to.
            return;
        }
        // SAFETY: nobody else has either any more.
        unsafe {
            ffi::libusb_free_transfer(self.transfer.as_ptr());
            drop(Box::from_raw(self.shared.as_ptr()));
        }
    }
}

/// Lets libusb work for at most `timeout`, or until a transfer has ended.
pub fn handle_events(context: &Context, timeout: Duration) -> rusb::Result<()> {
    let time = libc::timeval { tv_sec: timeout.as_secs() as _, tv_usec: timeout.subsec_micros() as _ };
    // SAFETY: the context is valid, the time is read before this returns, and there is no completion flag.
    let code = unsafe {
        ffi::libusb_handle_events_timeout_completed(context.as_raw(), &raw const time, std::ptr::null_mut())
    };
    if code == 0 { Ok(()) } else { Err(error(code)) }
}

fn error(code: c_int) -> rusb::Error {
    match code {
        rusb::constants::LIBUSB_ERROR_IO => rusb::Error::Io,
        rusb::constants::LIBUSB_ERROR_NO_DEVICE => rusb::Error::NoDevice,
        rusb::constants::LIBUSB_ERROR_BUSY => rusb::Error::Busy,
        rusb::constants::LIBUSB_ERROR_TIMEOUT => rusb::Error::Timeout,
        rusb::constants::LIBUSB_ERROR_PIPE => rusb::Error::Pipe,
        rusb::constants::LIBUSB_ERROR_INTERRUPTED => rusb::Error::Interrupted,
        rusb::constants::LIBUSB_ERROR_NO_MEM => rusb::Error::NoMem,
        _ => rusb::Error::Other,
    }
}
