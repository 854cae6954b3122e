//! The cable to an emulated Falcon.

use super::EmulatedFalcon;
use crate::falcon::transport::{LinkError, Transport, USB_PACKET_BYTES};
use hapflow_realtime::Clock;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A [`Transport`] to an [`EmulatedFalcon`], on a clock: on a virtual one, waiting for the device moves it.
pub struct EmulatedTransport {
    device: Arc<Mutex<EmulatedFalcon>>,
    clock: Arc<dyn Clock>,
    open: bool,
}

impl EmulatedTransport {
    /// A cable to `device`, which others may watch meanwhile.
    pub fn new(device: Arc<Mutex<EmulatedFalcon>>, clock: Arc<dyn Clock>) -> Self {
        Self { device, clock, open: true }
    }

    fn device(&self) -> Result<MutexGuard<'_, EmulatedFalcon>, LinkError> {
        if self.open {
            Ok(self.device.lock().unwrap_or_else(PoisonError::into_inner))
        } else {
            Err(LinkError::Unplugged)
        }
    }
}

impl Transport for EmulatedTransport {
    fn now_ns(&self) -> u64 {
        self.clock.now_ns()
    }

    fn control(&mut self, request: u8, value: u16) -> Result<(), LinkError> {
        let now = self.now_ns();
        self.device()?.control(request, value, now)
    }

    fn modem_status(&mut self) -> Result<u8, LinkError> {
        let now = self.now_ns();
        self.device()?.modem_status(now)
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        let now = self.now_ns();
        self.device()?.write(bytes, now)
    }

    fn read(&mut self, packet: &mut [u8; USB_PACKET_BYTES], deadline_ns: u64) -> Result<usize, LinkError> {
        loop {
            let now = self.now_ns();
            let (ready, next) = {
                let mut device = self.device()?;
                (device.read(packet, now)?, device.next_ns())
            };
            match ready {
                Some(len) => return Ok(len),
                None if now >= deadline_ns => return Ok(0),
                None => self.clock.wait_until_ns(next.min(deadline_ns)),
            }
        }
    }

    fn reopen(&mut self) -> Result<(), LinkError> {
        self.open = true;
        // Where the cable is out there is nothing to be had.
        self.modem_status().map(drop)
    }

    fn close(&mut self) {
        self.open = false;
    }
}
