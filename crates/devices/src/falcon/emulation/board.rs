//! The emulated board behind the chip: a supervisor that wakes the DSP, its boot loader, and the firmware.

use super::chip::Chip;
use super::{EmulatedHand, Trouble};
use crate::falcon::{ByteStream, Command, Firmware, Reply, serial::Baud};

/// What the host asks of the supervisor, and what it answers.
const ASK: &[u8] = &[0x0A, 0x43, 0x0D];
const ANSWER: [u8; 4] = [0x0A, 0x44, 0x2C, 0x0D];
/// Autobaud character of the DSP's boot ROM.
const AUTOBAUD: u8 = b'A';
/// How long the boot ROM takes to come up, ns. An assumption.
const BOOT_NS: u64 = 5_000_000;

/// Who listens on the line.
enum Listener {
    /// Nobody: the board was not woken since it was plugged in.
    Nobody,
    /// The supervisor; whether it has answered, and what it has heard.
    Supervisor { answered: bool, heard: Vec<u8> },
    /// The DSP's boot ROM, from a time on (ns), waits for its autobaud character.
    BootRom { from_ns: u64 },
    /// Its loader, with what it has so far.
    Loader { image: Vec<u8> },
    /// The firmware.
    Firmware(Box<ByteStream>),
}

pub(super) struct Board {
    listener: Listener,
    pub hand: EmulatedHand,
    pub trouble: Trouble,
    /// Commands that were answered.
    pub commands: u64,
    /// The newest command.
    pub newest: Command,
    /// Handshakes that were asked for.
    asked: u32,
    /// Images of which the loader has had the beginning.
    loads: u32,
}

impl Board {
    pub fn new(hand: EmulatedHand, trouble: Trouble, firmware_runs: bool) -> Self {
        let listener = if firmware_runs { Listener::Firmware(Box::default()) } else { Listener::Nobody };
        Self { listener, hand, trouble, commands: 0, newest: Command::default(), asked: 0, loads: 0 }
    }

    pub fn firmware_runs(&self) -> bool {
        matches!(self.listener, Listener::Firmware(_))
    }

    pub fn loaded_bytes(&self) -> usize {
        if let Listener::Loader { image } = &self.listener { image.len() } else { 0 }
    }

    /// The host has set DTR: a rising edge resets everything, a falling one lets the DSP boot that the supervisor has woken.
    pub fn dtr(&mut self, chip: &mut Chip, was: bool, now: u64) {
        chip.cts = match (&self.listener, was, chip.dtr) {
            (_, false, true) => {
                self.listener = Listener::Supervisor { answered: false, heard: Vec::new() };
                false
            }
            (Listener::Supervisor { answered: true, .. }, true, false) => {
                self.listener = Listener::BootRom { from_ns: now + BOOT_NS };
                true
            }
            _ => chip.cts,
        }
    }

    /// Bytes of the host, the last of which comes at `now`.
    pub fn hear(&mut self, chip: &mut Chip, bytes: &[u8], now: u64) {
        match &mut self.listener {
            Listener::Nobody => {}
            Listener::Supervisor { .. } if chip.baud == Baud::Supervisor as u16 => {
                self.wake(chip, bytes, now)
            }
            Listener::BootRom { from_ns } if chip.baud == Baud::Loader as u16 && now >= *from_ns => {
                self.take_speed(chip, bytes, now);
            }
            Listener::Loader { .. } if chip.baud == Baud::Loader as u16 => self.load(chip, bytes, now),
            Listener::Firmware(stream) if chip.baud == Baud::Run as u16 => {
                stream.push(bytes);
                self.answer(chip, now);
            }
            // At another speed nobody understands a thing.
            _ => {}
        }
    }

    fn wake(&mut self, chip: &mut Chip, bytes: &[u8], now: u64) {
        let Listener::Supervisor { answered, heard } = &mut self.listener else { return };
        heard.extend(bytes);
        if !heard.ends_with(ASK) {
            return;
        }
        heard.clear();
        self.asked += 1;
        if self.asked <= self.trouble.deaf_handshakes {
            return;
        }
        *answered = true;
        chip.receive(now, self.trouble.leading_zero.then_some(0).into_iter().chain(ANSWER));
    }

    fn take_speed(&mut self, chip: &mut Chip, bytes: &[u8], now: u64) {
        if bytes == [AUTOBAUD] {
            chip.receive(now, [AUTOBAUD]);
            self.listener = Listener::Loader { image: Vec::new() };
        }
    }

    fn load(&mut self, chip: &mut Chip, bytes: &[u8], now: u64) {
        let Listener::Loader { image } = &mut self.listener else { return };
        self.loads += u32::from(image.is_empty());
        image.extend(bytes);
        let spoil = u8::from(self.loads <= self.trouble.spoilt_loads);
        chip.receive(now, bytes.iter().map(|byte| byte ^ spoil));
        // A whole image ends with a block without words.
        if image.ends_with(&[0, 0]) && Firmware::check(image.clone()).is_ok() {
            self.listener = Listener::Firmware(Box::default());
            chip.cts = false;
        }
    }

    /// Answers every whole command.
    fn answer(&mut self, chip: &mut Chip, now: u64) {
        let Listener::Firmware(stream) = &mut self.listener else { return };
        while let Some(command) = stream.next(Command::decode) {
            self.newest = command;
            self.commands += 1;
            let reply = self.hand.obey(&command, now);
            self.trouble.send(chip, self.commands, &reply, now);
        }
    }
}

impl Trouble {
    /// Sends the reply to command `n`, or what becomes of it.
    fn send(&self, chip: &mut Chip, n: u64, reply: &Reply, now: u64) {
        let hits = |every: u64| every > 0 && n.is_multiple_of(every);
        if self.silent_after.is_some_and(|last| n > last) && !hits(self.speaks_every) {
            return;
        }
        let now = if hits(self.late_every) { now + self.late_ns } else { now };
        let mut reply = *reply;
        reply.encoders[n as usize % 3] ^= if hits(self.misreads_every) { 0x100 } else { 0 };
        let mut bytes = reply.encode().to_vec();
        if hits(self.loses_byte_every) {
            bytes.remove(n as usize % 16);
        }
        if hits(self.garbles_every) {
            bytes[(n / 2) as usize % 15] ^= 0x80;
        }
        chip.receive(now, bytes);
    }
}
