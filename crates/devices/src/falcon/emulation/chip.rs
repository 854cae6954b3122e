//! The emulated serial chip: bytes at the line's pace on one side, packets on the other.

use crate::falcon::serial::request;
use crate::falcon::transport::{LinkError, USB_PACKET_BYTES};
use std::collections::VecDeque;

/// Latency of a chip that was just plugged in, ns.
const POWER_ON_LATENCY_NS: u64 = 16_000_000;
/// The line's speeds are divisors of this, Hz.
const CLOCK_HZ: u64 = 3_000_000;
/// Start bit, eight bits, stop bit.
const BITS: u64 = 10;
/// First status byte without any line up.
const STATUS: u8 = 0x01;
/// Second one: both transmitters are empty.
const IDLE: u8 = 0x60;
const CTS: u8 = 0x10;

/// An FT232R. It ships what has come when a packet is full, or when its latency has passed since the last packet.
#[derive(Clone, Debug)]
pub(super) struct Chip {
    /// The baud request's value.
    pub baud: u16,
    pub dtr: bool,
    /// Raised by the board.
    pub cts: bool,
    latency_ns: u64,
    shipped_ns: u64,
    /// Bytes from the board, with the time at which each is whole.
    incoming: VecDeque<(u64, u8)>,
}

impl Default for Chip {
    fn default() -> Self {
        let latency_ns = POWER_ON_LATENCY_NS;
        Self { baud: 0, dtr: false, cts: false, latency_ns, shipped_ns: 0, incoming: VecDeque::new() }
    }
}

impl Chip {
    /// A vendor request.
    pub fn control(&mut self, number: u8, value: u16) -> Result<(), LinkError> {
        match number {
            request::RESET => self.incoming.clear(),
            request::MODEM if value & 0x0100 != 0 => self.dtr = value & 1 != 0,
            request::MODEM | request::FLOW | request::FORMAT => {}
            request::BAUD => self.baud = value,
            request::LATENCY => self.latency_ns = u64::from(value.clamp(1, 255)) * 1_000_000,
            _ => return Err(LinkError::Stalled),
        }
        Ok(())
    }

    pub fn modem_status(&self) -> u8 {
        STATUS | if self.cts { CTS } else { 0 }
    }

    /// How long a byte takes on the line, ns.
    pub fn byte_ns(&self) -> u64 {
        let halves = u64::from(self.baud & 0x3FFF) * 2 + u64::from(self.baud & 0xC000 == 0x4000);
        BITS * halves * 1_000_000_000 / (2 * CLOCK_HZ)
    }

    /// The board sends these bytes from `from_ns` on.
    pub fn receive(&mut self, from_ns: u64, bytes: impl IntoIterator<Item = u8>) {
        let mut at = self.incoming.back().map_or(from_ns, |(last, _)| from_ns.max(*last));
        for byte in bytes {
            at += self.byte_ns();
            self.incoming.push_back((at, byte));
        }
    }

    /// The packet that is ready by `now`, if there is one.
    pub fn packet(&mut self, now: u64, packet: &mut [u8; USB_PACKET_BYTES]) -> Option<usize> {
        if now < self.next_packet_ns() {
            return None;
        }
        self.shipped_ns = now;
        packet[..2].copy_from_slice(&[self.modem_status(), IDLE]);
        let mut len = 2;
        while len < USB_PACKET_BYTES
            && let Some((_, byte)) = self.incoming.pop_front_if(|(at, _)| *at <= now)
        {
            packet[len] = byte;
            len += 1;
        }
        Some(len)
    }

    /// When there will be a packet, ns.
    pub fn next_packet_ns(&self) -> u64 {
        let full = self.incoming.get(USB_PACKET_BYTES - 3).map_or(u64::MAX, |(at, _)| *at);
        full.min(self.shipped_ns + self.latency_ns)
    }
}
