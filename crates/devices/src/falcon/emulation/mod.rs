//! A Falcon that is not there: its serial chip, its start, its firmware, its arms and a hand, as far as they are known.
//!
//! It takes USB transfers with the time at which they come, so that it lives on any clock: a test's, or a real one.

mod board;
mod chip;
mod hand;
mod transport;

pub use hand::EmulatedHand;
pub use transport::EmulatedTransport;

use crate::falcon::Command;
use crate::falcon::transport::{LinkError, USB_PACKET_BYTES};
use board::Board;
use chip::Chip;

/// What goes wrong with it. Numbers of commands count from 1; 0 is never.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trouble {
    /// Handshakes that are not answered.
    pub deaf_handshakes: u32,
    /// The answer to a handshake begins with a zero, as on some hosts.
    pub leading_zero: bool,
    /// Uploads whose echo is wrong.
    pub spoilt_loads: u32,
    /// A byte is lost of every reply of this number.
    pub loses_byte_every: u64,
    /// A byte is changed of every reply of this number.
    pub garbles_every: u64,
    /// A digit is changed of every reply of this number, so that an encoder is 256 counts off.
    pub misreads_every: u64,
    /// Every reply of this number comes late, by [`late_ns`](Self::late_ns).
    pub late_every: u64,
    /// How late, ns.
    pub late_ns: u64,
    /// After this command it says no more,
    pub silent_after: Option<u64>,
    /// but for every reply of this number.
    pub speaks_every: u64,
    /// At this time its cable is pulled, ns.
    pub unplugged_ns: Option<u64>,
    /// Vendor requests that are refused.
    pub stalls: u32,
}

/// The device's side of the cable.
pub struct EmulatedFalcon {
    chip: Chip,
    board: Board,
}

impl EmulatedFalcon {
    /// A Falcon in a hand, just plugged in; `firmware_runs` is true where another program has left it running.
    pub fn new(hand: EmulatedHand, trouble: Trouble, firmware_runs: bool) -> Self {
        Self { chip: Chip::default(), board: Board::new(hand, trouble, firmware_runs) }
    }

    /// What goes wrong with it from now on.
    pub fn trouble(&mut self) -> &mut Trouble {
        &mut self.board.trouble
    }

    /// The hand.
    pub fn hand(&mut self) -> &mut EmulatedHand {
        &mut self.board.hand
    }

    /// The newest command that reached the firmware, and how many did.
    pub fn commanded(&self) -> (Command, u64) {
        (self.board.newest, self.board.commands)
    }

    /// Whether its firmware runs.
    pub fn firmware_runs(&self) -> bool {
        self.board.firmware_runs()
    }

    /// Bytes of an image that its loader has taken so far.
    pub fn loaded_bytes(&self) -> usize {
        self.board.loaded_bytes()
    }

    /// A vendor request without data.
    ///
    /// # Errors
    /// [`LinkError`] if it is unknown, or the cable is out.
    pub fn control(&mut self, request: u8, value: u16, now: u64) -> Result<(), LinkError> {
        self.plugged(now)?;
        if self.board.trouble.stalls > 0 {
            self.board.trouble.stalls -= 1;
            return Err(LinkError::Stalled);
        }
        let was = self.chip.dtr;
        self.chip.control(request, value)?;
        self.board.dtr(&mut self.chip, was, now);
        Ok(())
    }

    /// The modem status.
    ///
    /// # Errors
    /// [`LinkError`] if the cable is out.
    pub fn modem_status(&mut self, now: u64) -> Result<u8, LinkError> {
        self.plugged(now)?;
        Ok(self.chip.modem_status())
    }

    /// Bytes of the host.
    ///
    /// # Errors
    /// [`LinkError`] if the cable is out.
    pub fn write(&mut self, bytes: &[u8], now: u64) -> Result<(), LinkError> {
        self.plugged(now)?;
        let there = now + bytes.len() as u64 * self.chip.byte_ns();
        self.board.hear(&mut self.chip, bytes, there);
        Ok(())
    }

    /// The packet that is ready, if there is one, and its length.
    ///
    /// # Errors
    /// [`LinkError`] if the cable is out.
    pub fn read(
        &mut self,
        packet: &mut [u8; USB_PACKET_BYTES],
        now: u64,
    ) -> Result<Option<usize>, LinkError> {
        self.plugged(now)?;
        self.board.hand.live(now);
        Ok(self.chip.packet(now, packet))
    }

    /// When it has something to say next, ns: a packet, or that its cable is out.
    pub fn next_ns(&self) -> u64 {
        self.chip.next_packet_ns().min(self.board.trouble.unplugged_ns.unwrap_or(u64::MAX))
    }

    fn plugged(&self, now: u64) -> Result<(), LinkError> {
        match self.board.trouble.unplugged_ns {
            Some(at) if now >= at => Err(LinkError::Unplugged),
            _ => Ok(()),
        }
    }
}
