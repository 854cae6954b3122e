//! Falcons at this machine's USB, by libusb.

mod transfer;

use crate::falcon::PluggedIn;
use crate::falcon::error::FalconError;
use crate::falcon::transport::{LinkError, Transport, USB_PACKET_BYTES};
use rusb::{Context, Device, DeviceHandle, UsbContext};
use std::time::{Duration, Instant};
use transfer::{Ended, Transfer, handle_events};

/// The serial chip's maker, and Novint's number there.
const VENDOR: u16 = 0x0403;
const PRODUCT: u16 = 0xCB48;
const INTERFACE: u8 = 0;
const ENDPOINT_IN: u8 = 0x81;
const ENDPOINT_OUT: u8 = 0x02;
const VENDOR_OUT: u8 = 0x40;
const VENDOR_IN: u8 = 0xC0;
const GET_MODEM_STATUS: u8 = 5;
const CONTROL_TIMEOUT: Duration = Duration::from_secs(1);
/// IN transfers that always wait in the kernel, so that no frame passes without one.
const QUEUED_IN: usize = 4;
const QUEUED_OUT: usize = 2;
/// A packet that the chip does not take in this time is given up, ms.
const OUT_TIMEOUT_MS: u32 = 100;
/// How long transfers that are called back may take to come.
const CLOSE_TIMEOUT: Duration = Duration::from_secs(1);

/// Every Falcon that is plugged in. Thread: main.
///
/// # Errors
/// [`FalconError::NoUsb`] if there is no USB.
pub fn plugged_in() -> Result<Vec<PluggedIn>, FalconError> {
    let found = devices(&context()?)?;
    Ok(found
        .iter()
        .map(|d| PluggedIn { bus: d.bus_number(), address: d.address(), serial: serial(d) })
        .collect())
}

/// A way to the Falcon with that serial number, or to the first one. Thread: main.
///
/// # Errors
/// [`FalconError`] if there is none, or it cannot be had.
pub fn open(serial: Option<&str>) -> Result<Box<dyn Transport>, FalconError> {
    Ok(Box::new(UsbTransport::open(serial)?))
}

fn context() -> Result<Context, FalconError> {
    Context::new().map_err(no_usb)
}

fn no_usb(cause: rusb::Error) -> FalconError {
    // libusb's word for a system without any bus.
    let cause = if cause == rusb::Error::Other { "there is no bus".into() } else { cause.to_string() };
    FalconError::NoUsb { cause }
}

fn devices(context: &Context) -> Result<Vec<Device<Context>>, FalconError> {
    let all = context.devices().map_err(no_usb)?;
    let is_falcon = |device: &Device<Context>| {
        let ids = device.device_descriptor();
        ids.is_ok_and(|ids| (ids.vendor_id(), ids.product_id()) == (VENDOR, PRODUCT))
    };
    Ok(all.iter().filter(is_falcon).collect())
}

fn serial(device: &Device<Context>) -> Result<String, FalconError> {
    let handle = device.open().map_err(open_error)?;
    let ids = device.device_descriptor().map_err(open_error)?;
    Ok(handle.read_serial_number_string_ascii(&ids).unwrap_or_default())
}

fn open_error(cause: rusb::Error) -> FalconError {
    match cause {
        rusb::Error::Access => FalconError::NoPermission,
        // On Windows: another driver than WinUSB.
        rusb::Error::Busy | rusb::Error::NotSupported => FalconError::Busy,
        rusb::Error::NoDevice => FalconError::NotFound { serial: None },
        cause => FalconError::Open { cause: cause.to_string() },
    }
}

fn link_error(cause: rusb::Error) -> LinkError {
    match cause {
        rusb::Error::NoDevice => LinkError::Unplugged,
        rusb::Error::Pipe => LinkError::Stalled,
        rusb::Error::Timeout => LinkError::TimedOut,
        rusb::Error::Io => LinkError::Other("a transfer failed"),
        rusb::Error::NoMem => LinkError::Other("there is no memory for a transfer"),
        _ => LinkError::Other("libusb failed"),
    }
}

/// Transfers to one Falcon, a queue of them in each direction. They end in the order in which they were submitted.
struct UsbTransport {
    incoming: Vec<Transfer>,
    outgoing: Vec<Transfer>,
    /// The transfer that ends next, and that which is free next.
    next_in: usize,
    next_out: usize,
    /// Dropped last: the transfers belong to it. None while it is closed.
    handle: Option<DeviceHandle<Context>>,
    context: Context,
    serial: Option<String>,
    origin: Instant,
}

impl UsbTransport {
    fn open(serial: Option<&str>) -> Result<Self, FalconError> {
        let mut transport = Self {
            incoming: Vec::new(),
            outgoing: Vec::new(),
            next_in: 0,
            next_out: 0,
            handle: None,
            context: context()?,
            serial: serial.map(str::to_owned),
            origin: Instant::now(),
        };
        transport.claim()?;
        Ok(transport)
    }

    /// Takes the device, and begins to listen.
    fn claim(&mut self) -> Result<(), FalconError> {
        let device = self.find()?;
        let handle = device.open().map_err(open_error)?;
        // Not every system has kernel drivers to detach.
        let _ = handle.set_auto_detach_kernel_driver(true);
        handle.claim_interface(INTERFACE).map_err(open_error)?;
        let (ins, outs) = (0..QUEUED_IN, 0..QUEUED_OUT);
        self.incoming = ins.filter_map(|_| Transfer::new(&handle, ENDPOINT_IN, 0)).collect();
        self.outgoing = outs.filter_map(|_| Transfer::new(&handle, ENDPOINT_OUT, OUT_TIMEOUT_MS)).collect();
        (self.next_in, self.next_out) = (0, 0);
        self.handle = Some(handle);
        if self.incoming.len() < QUEUED_IN || self.outgoing.len() < QUEUED_OUT {
            return Err(open_error(rusb::Error::NoMem));
        }
        self.incoming.iter_mut().try_for_each(Transfer::submit).map_err(open_error)
    }

    /// The device with the serial number that was asked for, or the first one.
    fn find(&self) -> Result<Device<Context>, FalconError> {
        let found = devices(&self.context)?;
        let Some(wanted) = &self.serial else {
            return found.into_iter().next().ok_or(FalconError::NotFound { serial: None });
        };
        let mut refused = FalconError::NotFound { serial: Some(wanted.clone()) };
        for device in found {
            match serial(&device) {
                Ok(serial) if serial == *wanted => return Ok(device),
                Ok(_) => {}
                // It may have been this one.
                Err(error) => refused = error,
            }
        }
        Err(refused)
    }

    fn handle(&self) -> Result<&DeviceHandle<Context>, LinkError> {
        self.handle.as_ref().ok_or(LinkError::Unplugged)
    }

    /// What a transfer came to. After a stall the endpoint goes on once the host has said so: that packet is lost, and nothing else.
    fn go_on_after(&self, ended: Result<(), LinkError>, endpoint: u8) -> Result<(), LinkError> {
        match ended {
            Err(LinkError::Stalled) => self.handle()?.clear_halt(endpoint).map_err(link_error),
            ended => ended,
        }
    }

    fn work(&self, timeout: Duration) -> Result<(), LinkError> {
        match handle_events(&self.context, timeout) {
            Ok(()) | Err(rusb::Error::Interrupted) => Ok(()),
            Err(error) => Err(link_error(error)),
        }
    }

    /// Waits for transfers that `are_left`, for at most `timeout`.
    fn wait(&self, timeout: Duration, are_left: impl Fn(&Self) -> bool) -> Result<(), LinkError> {
        let end = Instant::now() + timeout;
        while are_left(self) {
            let left = end.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Err(LinkError::TimedOut);
            }
            self.work(left)?;
        }
        Ok(())
    }
}

/// What a transfer that ended badly means.
fn check(transfer: &Transfer) -> Result<(), LinkError> {
    match transfer.ended() {
        Ended::Done => Ok(()),
        Ended::Stalled => Err(LinkError::Stalled),
        Ended::TimedOut => Err(LinkError::TimedOut),
        Ended::Unplugged => Err(LinkError::Unplugged),
        Ended::Failed => Err(LinkError::Other("a transfer failed")),
    }
}

impl Transport for UsbTransport {
    fn now_ns(&self) -> u64 {
        self.origin.elapsed().as_nanos() as u64
    }

    fn control(&mut self, request: u8, value: u16) -> Result<(), LinkError> {
        let done = self.handle()?.write_control(VENDOR_OUT, request, value, 0, &[], CONTROL_TIMEOUT);
        done.map(drop).map_err(link_error)
    }

    fn modem_status(&mut self) -> Result<u8, LinkError> {
        let mut status = [0; 2];
        let read =
            self.handle()?.read_control(VENDOR_IN, GET_MODEM_STATUS, 0, 0, &mut status, CONTROL_TIMEOUT);
        read.map(|_| status[0]).map_err(link_error)
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.handle()?;
        for packet in bytes.chunks(USB_PACKET_BYTES) {
            let next = self.next_out;
            self.wait(CLOSE_TIMEOUT, |this| this.outgoing[next].is_under_way())?;
            self.go_on_after(check(&self.outgoing[next]), ENDPOINT_OUT)?;
            self.outgoing[next].send(packet).map_err(link_error)?;
            self.next_out = (next + 1) % QUEUED_OUT;
        }
        Ok(())
    }

    fn read(&mut self, packet: &mut [u8; USB_PACKET_BYTES], deadline_ns: u64) -> Result<usize, LinkError> {
        self.handle()?;
        let next = self.next_in;
        while self.incoming[next].is_under_way() {
            let left = Duration::from_nanos(deadline_ns.saturating_sub(self.now_ns()));
            // Even without time left: what has come already is taken.
            self.work(left)?;
            if left.is_zero() && self.incoming[next].is_under_way() {
                return Ok(0);
            }
        }
        let ended = check(&self.incoming[next]);
        let len = self.incoming[next].take(packet);
        self.go_on_after(ended, ENDPOINT_IN)?;
        self.incoming[next].submit().map_err(link_error)?;
        self.next_in = (next + 1) % QUEUED_IN;
        Ok(if ended.is_ok() { len } else { 0 })
    }

    fn reopen(&mut self) -> Result<(), LinkError> {
        self.close();
        self.claim().map_err(|error| match error {
            FalconError::NotFound { .. } => LinkError::Unplugged,
            _ => LinkError::Other("it cannot be opened again"),
        })
    }

    fn close(&mut self) {
        let Some(handle) = self.handle.take() else { return };
        let out = Duration::from_millis(u64::from(OUT_TIMEOUT_MS));
        let _ = self.wait(out, |this| this.outgoing.iter().any(Transfer::is_under_way));
        let under_way = |this: &Self| this.incoming.iter().chain(&this.outgoing).any(Transfer::is_under_way);
        self.incoming.iter_mut().chain(&mut self.outgoing).for_each(Transfer::cancel);
        let _ = self.wait(CLOSE_TIMEOUT, under_way);
        self.incoming.clear();
        self.outgoing.clear();
        let _ = handle.release_interface(INTERFACE);
    }
}

impl Drop for UsbTransport {
    fn drop(&mut self) {
        self.close();
    }
}
