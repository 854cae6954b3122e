//! From a Falcon that was plugged in to one that answers.
//!
//! A supervisor at 9600 baud is asked to wake the DSP, whose boot ROM (TI, SPRU095: SCI boot) finds the line's speed by
//! an `A` and takes the image, of which it echoes every byte.

use crate::falcon::error::{FalconError, Stage};
use crate::falcon::exchange::Exchange;
use crate::falcon::serial::{Baud, Line};
use crate::falcon::{Command, Firmware, LinkError};

const MS: u64 = 1_000_000;

/// Whole attempts, each with the device taken anew.
const ATTEMPTS: u32 = 10;
/// What the supervisor is asked, how often in an attempt, and how long it has for an answer.
const ASK: &[u8] = &[0x0A, 0x43, 0x0D];
const ASKS: u32 = 15;
const ANSWER: &[u8] = &[0x0A, 0x44, 0x2C, 0x0D];
const ANSWER_NS: u64 = 200 * MS;
/// The line is quiet when nothing has come for so long.
const QUIET_NS: u64 = 40 * MS;
/// How long CTS may take to say that the boot ROM is up. Nobody knows whether it always does.
const CTS_NS: u64 = 100 * MS;
/// The boot ROM's autobaud character, and how long it has to return it.
const AUTOBAUD: u8 = b'A';
const AUTOBAUD_NS: u64 = 200 * MS;
/// The image is sent in full packets, each of which has so long to come back.
const CHUNK: usize = 62;
const ECHO_NS: u64 = 500 * MS;
/// The firmware's time to start.
const START_NS: u64 = 50 * MS;
/// Commands that are sent to see whether a firmware runs, and how long each may take.
const PROBES: u32 = 2;
const PROBE_NS: u64 = 50 * MS;
/// Latency of the serial chip while booting and running, ms.
const BOOT_LATENCY_MS: u16 = 16;
const RUN_LATENCY_MS: u16 = 1;

/// How an attempt ended that failed.
type Failed = (Stage, &'static str);

/// Takes the line to the firmware's speed, and says whether one runs. Sends nothing but zero force.
pub fn runs(exchange: &mut Exchange) -> Result<bool, LinkError> {
    exchange.line.set_up(Baud::Run, RUN_LATENCY_MS)?;
    exchange.line.set(Line::Rts, false)?;
    exchange.line.set(Line::Dtr, false)?;
    for _ in 0..PROBES {
        exchange.send(&Command::default())?;
        let deadline = exchange.line.now_ns() + PROBE_NS;
        if exchange.reply(deadline)?.is_some() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Loads `firmware`, in as many attempts as it takes; `tell` gets a line for each.
pub fn load(
    exchange: &mut Exchange,
    firmware: &Firmware,
    tell: &mut dyn FnMut(&str),
) -> Result<(), FalconError> {
    let mut last = (Stage::Handshake, "");
    for attempt in 1..=ATTEMPTS {
        tell(&format!("loading firmware, attempt {attempt} of {ATTEMPTS}"));
        match attempt_load(exchange, firmware) {
            Ok(()) => return Ok(()),
            Err(failed) => last = failed,
        }
        exchange.line.close();
        exchange.line.reopen()?;
    }
    let (stage, cause) = last;
    Err(FalconError::NotAccepted { stage, attempts: ATTEMPTS, cause })
}

fn attempt_load(exchange: &mut Exchange, firmware: &Firmware) -> Result<(), Failed> {
    handshake(exchange).map_err(at(Stage::Handshake))?;
    autobaud(exchange).map_err(at(Stage::Autobaud))?;
    image(exchange, firmware.bytes())?;
    start(exchange).map_err(at(Stage::Start))
}

/// Names the stage of a failure.
fn at(stage: Stage) -> impl Fn(Trouble) -> Failed {
    move |trouble| (stage, trouble.0)
}

/// What went wrong in a stage.
struct Trouble(&'static str);

impl From<LinkError> for Trouble {
    fn from(error: LinkError) -> Self {
        Self(match error {
            LinkError::Unplugged => "it was unplugged",
            LinkError::Stalled => "it refused a transfer",
            LinkError::TimedOut => "a transfer took too long",
            LinkError::Other(cause) => cause,
        })
    }
}

fn handshake(exchange: &mut Exchange) -> Result<(), Trouble> {
    let line = &mut exchange.line;
    line.set_up(Baud::Supervisor, BOOT_LATENCY_MS)?;
    line.set(Line::Rts, false)?;
    line.set(Line::Dtr, false)?;
    // This edge resets the board.
    line.set(Line::Dtr, true)?;
    for _ in 0..ASKS {
        exchange.line.write(ASK)?;
        if hear(exchange, ANSWER_NS, |heard| heard.windows(ANSWER.len()).any(|w| w == ANSWER))? {
            return Ok(exchange.drain(QUIET_NS)?);
        }
    }
    Err(Trouble("it does not answer"))
}

/// Listens for at most `for_ns` until what was heard is `enough`, and says whether it was.
fn hear(exchange: &mut Exchange, for_ns: u64, enough: impl Fn(&[u8]) -> bool) -> Result<bool, LinkError> {
    let deadline = exchange.line.now_ns() + for_ns;
    let mut heard = Vec::new();
    while exchange.line.now_ns() < deadline {
        heard.extend(exchange.line.read(deadline)?);
        if enough(&heard) {
            return Ok(true);
        }
    }
    Ok(false)
}

fn autobaud(exchange: &mut Exchange) -> Result<(), Trouble> {
    exchange.line.set(Line::Dtr, false)?;
    exchange.line.set_baud(Baud::Loader)?;
    let deadline = exchange.line.now_ns() + CTS_NS;
    while exchange.line.now_ns() < deadline && !exchange.line.clear_to_send()? {
        exchange.line.read(deadline.min(exchange.line.now_ns() + MS))?;
    }
    // Up, but perhaps only just.
    exchange.drain(QUIET_NS)?;
    exchange.line.write(&[AUTOBAUD])?;
    if hear(exchange, AUTOBAUD_NS, |heard| heard == [AUTOBAUD])? {
        return Ok(());
    }
    Err(Trouble("the boot loader does not return its character"))
}

fn image(exchange: &mut Exchange, bytes: &[u8]) -> Result<(), Failed> {
    for (n, chunk) in bytes.chunks(CHUNK).enumerate() {
        let stage = at(Stage::Image { echoed: n * CHUNK, of: bytes.len() });
        echo(exchange, chunk).map_err(stage)?;
    }
    Ok(())
}

/// Sends bytes, and sees that they come back.
fn echo(exchange: &mut Exchange, bytes: &[u8]) -> Result<(), Trouble> {
    exchange.line.write(bytes)?;
    let mut echoed = 0;
    let deadline = exchange.line.now_ns() + ECHO_NS;
    while echoed < bytes.len() {
        let heard = exchange.line.read(deadline)?;
        if heard.is_empty() {
            return Err(Trouble("the echo stays away"));
        }
        if !bytes[echoed..].starts_with(heard) {
            return Err(Trouble("the echo is wrong"));
        }
        echoed += heard.len();
    }
    Ok(())
}

fn start(exchange: &mut Exchange) -> Result<(), Trouble> {
    exchange.line.set_up(Baud::Run, RUN_LATENCY_MS)?;
    exchange.drain(START_NS)?;
    if runs(exchange)? { Ok(()) } else { Err(Trouble("no answer")) }
}
