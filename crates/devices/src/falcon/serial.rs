//! The serial line that an FT232R makes of USB: its requests, and its status bytes.
//!
//! Requests and bits as in Linux, `drivers/usb/serial/ftdi_sio.h`.

use crate::falcon::transport::{LinkError, Transport, USB_PACKET_BYTES};

/// A request's number.
pub mod request {
    /// Reset, and purges by value.
    pub const RESET: u8 = 0;
    /// DTR and RTS.
    pub const MODEM: u8 = 1;
    /// Flow control.
    pub const FLOW: u8 = 2;
    /// Baud rate, by divisor of 3 MHz.
    pub const BAUD: u8 = 3;
    /// Bits of a character.
    pub const FORMAT: u8 = 4;
    /// Time after which the chip ships what it has, ms.
    pub const LATENCY: u8 = 9;
}

/// The request's value for each purge: which is which differs between manuals, so both are always sent.
const PURGES: [u16; 2] = [1, 2];
/// Eight bits, no parity, one stop bit.
const FORMAT_8N1: u16 = 8;
/// Parity, framing, overrun and break, and a FIFO error, of the second status byte.
const LINE_ERRORS: u8 = 0b1001_1110;
const CTS: u8 = 0x10;

/// Speeds of the line, as the request's value: the divisor of 3 MHz, and eighths of it in the upper bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Baud {
    /// 9600: the supervisor that wakes the DSP.
    Supervisor = 0x4138,
    /// 142 857: the DSP's boot loader.
    Loader = 0x0015,
    /// 1 500 000: the firmware.
    Run = 0x0002,
}

/// One of the two lines that the host sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// Data terminal ready.
    Dtr = 0x0100,
    /// Request to send.
    Rts = 0x0200,
}

/// A serial line over a [`Transport`].
pub struct SerialLine {
    transport: Box<dyn Transport>,
    packet: [u8; USB_PACKET_BYTES],
    errors: u64,
}

impl SerialLine {
    /// The line behind `transport`.
    pub fn new(transport: Box<dyn Transport>) -> Self {
        Self { transport, packet: [0; USB_PACKET_BYTES], errors: 0 }
    }

    /// The time, ns.
    pub fn now_ns(&self) -> u64 {
        self.transport.now_ns()
    }

    /// Packets so far that came with a line error.
    pub fn errors(&self) -> u64 {
        self.errors
    }

    /// Sets speed and latency (ms), with 8N1 and no flow control, and forgets what is under way.
    pub fn set_up(&mut self, baud: Baud, latency_ms: u16) -> Result<(), LinkError> {
        self.transport.control(request::LATENCY, latency_ms)?;
        self.set_baud(baud)?;
        self.transport.control(request::FORMAT, FORMAT_8N1)?;
        self.transport.control(request::FLOW, 0)?;
        self.purge()
    }

    /// Sets the speed alone.
    pub fn set_baud(&mut self, baud: Baud) -> Result<(), LinkError> {
        self.transport.control(request::BAUD, baud as u16)
    }

    /// Raises or drops a line.
    pub fn set(&mut self, line: Line, high: bool) -> Result<(), LinkError> {
        let bit = line as u16;
        self.transport.control(request::MODEM, if high { bit | bit >> 8 } else { bit })
    }

    /// Forgets what is under way, in both directions.
    pub fn purge(&mut self) -> Result<(), LinkError> {
        PURGES.into_iter().try_for_each(|purge| self.transport.control(request::RESET, purge))
    }

    /// Whether the device raises CTS.
    pub fn clear_to_send(&mut self) -> Result<bool, LinkError> {
        Ok(self.transport.modem_status()? & CTS != 0)
    }

    /// Sends bytes.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.transport.write(bytes)
    }

    /// The next bytes, one to 62; none if none come until `deadline_ns`. What has come already is found even later than that.
    /// Packets that carry only their status, as the chip sends one each latency period, are passed over.
    pub fn read(&mut self, deadline_ns: u64) -> Result<&[u8], LinkError> {
        loop {
            let len = self.transport.read(&mut self.packet, deadline_ns)?.min(USB_PACKET_BYTES);
            self.errors += u64::from(len >= 2 && self.packet[1] & LINE_ERRORS != 0);
            if len > 2 {
                return Ok(&self.packet[2..len]);
            }
            if len == 0 && self.now_ns() >= deadline_ns {
                return Ok(&[]);
            }
        }
    }

    /// Lets go of the device and takes it anew.
    pub fn reopen(&mut self) -> Result<(), LinkError> {
        self.transport.reopen()
    }

    /// Lets go of the device.
    pub fn close(&mut self) {
        self.transport.close();
    }
}
