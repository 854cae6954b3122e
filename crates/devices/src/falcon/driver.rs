//! The Falcon as a device.

use crate::falcon::boot;
use crate::falcon::error::FalconError;
use crate::falcon::exchange::Exchange;
use crate::falcon::serial::SerialLine;
use crate::falcon::{
    Command, Firmware, Geometry, Kinematics, Leds, LinkError, Reply, Transport, motor_counts,
};
use crate::{DeviceError, HapticDevice, Pacing};
use glam::DVec3;
use hapflow_haptics::{GatedWrench, ToolState, VelocityEstimator};
use std::ops::ControlFlow;

const NAME: &str = "falcon";
const MS: u64 = 1_000_000;

/// A command that was not answered for so long is sent again,
const RESEND_NS: u64 = 5 * MS;
/// from here on without force,
const ZERO_NS: u64 = 20 * MS;
/// and here the device is lost.
const LOST_NS: u64 = 100 * MS;
/// After a command was sent again two answers may come: the second one within so long.
const STRAGGLER_NS: u64 = 2 * MS;
/// Time in which the force comes back after a silence, s.
const RETURN_S: f64 = 0.1;
/// A person who homes is told so often what to do.
const TELL_NS: u64 = 100 * MS;
/// Arms that stand still for so long while a person is asked to move them have no supply.
const STILL_NS: u64 = 30_000 * MS;
/// An arm that moves by more counts than this does not stand still.
const STILL_COUNTS: u16 = 8;
/// Arms turn no faster than this, counts a second: some 60 rad/s, 4 m/s at the grip;
const FASTEST_COUNTS_PER_S: f64 = 100_000.0;
/// and so many counts more are believed from one reply to the next.
const JUMP_COUNTS: f64 = 16.0;
/// A button counts once so many replies in a row say the same.
const SAME_REPLIES: u8 = 3;
/// Commands without force at the end.
const LAST_COMMANDS: u32 = 3;

/// Settings of a [`Falcon`].
#[derive(Clone, Debug, PartialEq)]
pub struct FalconOptions {
    /// Lengths, zero angles and strengths.
    pub geometry: Geometry,
    /// What to load if it has just been plugged in.
    pub firmware: Option<Firmware>,
    /// Load it even if one runs already.
    pub always_load: bool,
    /// Leave the homing bit set while running, so that a device that forgets its marks says so. Default true; whether a
    /// device needs it set is not known.
    pub keep_homing: bool,
    /// Added to every place, m: default, the middle of the workspace becomes the origin.
    pub offset: DVec3,
    /// Cutoff of the velocity estimate, Hz, 1 to 10 000.
    pub velocity_cutoff_hz: f64,
}

impl FalconOptions {
    /// The middle of the workspace in the Falcon's own frame, m.
    pub const MIDDLE: DVec3 = DVec3::new(0.0, 0.0, 0.125);

    /// The defaults, for this geometry.
    pub fn new(geometry: Geometry) -> Self {
        Self {
            geometry,
            firmware: None,
            always_load: false,
            keep_homing: true,
            offset: -Self::MIDDLE,
            velocity_cutoff_hz: VelocityEstimator::DEFAULT_CUTOFF_HZ,
        }
    }
}

/// How the exchange goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FalconStats {
    /// Replies so far.
    pub replies: u64,
    /// Commands that had to be sent again.
    pub resent: u64,
    /// Replies whose counts no pose has, or that are too far from the last ones.
    pub unsound: u64,
    /// Bytes that belonged to no reply.
    pub dropped_bytes: u64,
    /// USB packets that came with a line error.
    pub line_errors: u64,
    /// The encoders, as they came last.
    pub encoders: [i16; 3],
    /// The motors, as they were commanded last.
    pub motors: [i16; 3],
}

/// What it may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Nothing: it is not homed.
    Waiting,
    /// Give force.
    Ready,
    /// Nothing any more.
    Closed,
}

/// A Novint Falcon. The device paces: [`read`](HapticDevice::read) waits for the reply to the command that
/// [`write`](HapticDevice::write) sent, at up to 1 kHz. Places are in the device's axes (x right, y up, z towards the user).
///
/// A command without a reply is sent again after 5 ms, from 20 ms on without force, and after 100 ms the device is lost.
/// Force comes back in 0.1 s after such a silence. Without all three marks there is no force at all.
pub struct Falcon {
    exchange: Exchange,
    kinematics: Kinematics,
    options: FalconOptions,
    state: State,
    command: Command,
    /// When the oldest command without a reply was sent, ns.
    asked_ns: Option<u64>,
    sent_ns: u64,
    /// When the newest encoder counts that were believed were asked for, ns, and what they are.
    believed: (u64, [i16; 3]),
    /// Share of the force that is given, 0 to 1.
    gain: f64,
    place: DVec3,
    velocity: VelocityEstimator,
    buttons: Buttons,
    stats: FalconStats,
}

impl std::fmt::Debug for Falcon {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Falcon")
            .field("state", &self.state)
            .field("stats", &self.stats)
            .finish_non_exhaustive()
    }
}

impl Falcon {
    /// The Falcon behind `transport`. Nothing is sent before [`prepare`](HapticDevice::prepare).
    ///
    /// # Errors
    /// [`DeviceError::Setting`] if an option is outside its range.
    pub fn new(transport: Box<dyn Transport>, options: FalconOptions) -> Result<Self, DeviceError> {
        options.geometry.check()?;
        Ok(Self {
            exchange: Exchange::new(SerialLine::new(transport)),
            kinematics: Kinematics::new(options.geometry.clone()),
            velocity: VelocityEstimator::new(options.velocity_cutoff_hz)?,
            options,
            state: State::Waiting,
            command: Command::default(),
            asked_ns: None,
            sent_ns: 0,
            believed: (0, [0; 3]),
            gain: 1.0,
            place: FalconOptions::MIDDLE,
            buttons: Buttons::default(),
            stats: FalconStats::default(),
        })
    }

    /// How the exchange goes so far.
    pub fn stats(&self) -> FalconStats {
        let (dropped_bytes, line_errors) = (self.exchange.dropped_bytes(), self.exchange.line.errors());
        FalconStats { dropped_bytes, line_errors, motors: self.command.motors, ..self.stats }
    }

    /// The time on the device's own clock, s.
    pub(super) fn now_s(&self) -> f64 {
        self.exchange.line.now_ns() as f64 * 1e-9
    }

    /// The middle of its workspace, as it tells places, m.
    pub(super) fn middle(&self) -> DVec3 {
        FalconOptions::MIDDLE + self.options.offset
    }

    /// Brings it to where its firmware answers, loading one if none runs. Thread: main, may take seconds.
    ///
    /// # Errors
    /// [`FalconError`] with the stage at which it got stuck.
    pub fn start(&mut self, tell: &mut dyn FnMut(&str)) -> Result<(), FalconError> {
        if !self.options.always_load && boot::runs(&mut self.exchange)? {
            return Ok(());
        }
        let firmware = self.options.firmware.take().ok_or(FalconError::NoFirmware)?;
        let loaded = boot::load(&mut self.exchange, &firmware, tell);
        self.options.firmware = Some(firmware);
        loaded
    }

    /// Asks a person to lead the arms past their marks. `tell` gets about ten times a second what to do, and may break it
    /// off. Thread: main, waits for the person.
    ///
    /// # Errors
    /// [`FalconError`] if the arms stand still for half a minute, their counts have no pose, the device is lost, or it was broken off.
    pub fn home(&mut self, tell: &mut dyn FnMut(&str) -> ControlFlow<()>) -> Result<(), FalconError> {
        self.command = Command { homing: true, leds: Leds::RED, motors: [0; 3] };
        let mut moved = (self.exchange.line.now_ns(), [0; 3]);
        let (mut told_ns, mut homed) = (0, 0);
        loop {
            let reply = self.ask()?;
            let now = self.exchange.line.now_ns();
            if reply.homed == Reply::HOMED && self.locate(&reply) {
                break;
            }
            if now >= told_ns + TELL_NS || reply.homed != homed {
                (told_ns, homed) = (now, reply.homed);
                if tell(&homing_text(reply.homed)).is_break() {
                    return Err(FalconError::Stopped);
                }
            }
            if far(moved.1, reply.encoders) {
                moved = (now, reply.encoders);
            } else if now >= moved.0 + STILL_NS {
                let found = reply.homed == Reply::HOMED;
                return Err(if found { FalconError::NoPose } else { FalconError::NeverHomes });
            }
        }
        self.velocity.reset();
        self.believed = (self.sent_ns, self.stats.encoders);
        self.command.homing = self.options.keep_homing;
        self.command.leds = Leds::BLUE;
        self.state = State::Ready;
        let _ = tell("homed");
        Ok(())
    }

    /// Sends the command as it stands, if none is under way, and gives the reply.
    fn ask(&mut self) -> Result<Reply, FalconError> {
        if self.asked_ns.is_none() {
            self.send()?;
        }
        let mut resent = false;
        loop {
            if let Some(mut reply) = self.exchange.reply(self.sent_ns + RESEND_NS)? {
                if resent {
                    reply = self.last_of_both(reply)?;
                }
                self.rest_after(self.silent_ns());
                self.asked_ns = None;
                self.stats.replies += 1;
                self.stats.encoders = reply.encoders;
                return Ok(reply);
            }
            self.send_again()?;
            resent = true;
        }
    }

    /// The reply to the second of two commands, if it comes.
    fn last_of_both(&mut self, first: Reply) -> Result<Reply, FalconError> {
        let until = self.exchange.line.now_ns() + STRAGGLER_NS;
        Ok(self.exchange.reply(until)?.unwrap_or(first))
    }

    fn send_again(&mut self) -> Result<(), FalconError> {
        if self.silent_ns() >= LOST_NS {
            return Err(LinkError::TimedOut.into());
        }
        self.rest_after(self.silent_ns());
        self.stats.resent += 1;
        self.send()
    }

    /// How long the oldest command is without a reply, ns.
    fn silent_ns(&self) -> u64 {
        self.exchange.line.now_ns() - self.asked_ns.unwrap_or(self.sent_ns)
    }

    /// After a silence of this length there is no force, which then has to come up anew.
    fn rest_after(&mut self, silent_ns: u64) {
        if silent_ns >= ZERO_NS {
            self.command.motors = [0; 3];
            self.gain = 0.0;
        }
    }

    fn send(&mut self) -> Result<(), FalconError> {
        self.exchange.send(&self.command)?;
        self.sent_ns = self.exchange.line.now_ns();
        self.asked_ns.get_or_insert(self.sent_ns);
        Ok(())
    }

    /// Takes the place from a reply; false if its counts have none.
    fn locate(&mut self, reply: &Reply) -> bool {
        let angles = self.kinematics.geometry().angles(reply.encoders);
        let found = self.kinematics.forward(angles, self.place);
        self.stats.unsound += u64::from(found.is_err());
        self.place = found.unwrap_or(self.place);
        found.is_ok()
    }

    /// Whether the arms can have come to where a reply says from where they were, in the time between: a spoilt digit looks like a
    /// jump, which nobody may feel. The longer ago that was the more is believed.
    fn follows(&mut self, reply: &Reply) -> bool {
        let (last_ns, last) = self.believed;
        let most = JUMP_COUNTS + (self.sent_ns - last_ns) as f64 * 1e-9 * FASTEST_COUNTS_PER_S;
        let follows = last.into_iter().zip(reply.encoders).all(|(a, b)| f64::from(a.abs_diff(b)) <= most);
        self.stats.unsound += u64::from(!follows);
        if follows {
            self.believed = (self.sent_ns, reply.encoders);
        }
        follows
    }

    /// The next reply with a pose.
    fn locate_next(&mut self) -> Result<Reply, FalconError> {
        let begin = self.exchange.line.now_ns();
        loop {
            let reply = self.ask()?;
            let now = self.exchange.line.now_ns();
            if self.command.homing && reply.homed != Reply::HOMED {
                return Err(FalconError::Unhomed);
            }
            if self.follows(&reply) && self.locate(&reply) {
                return Ok(reply);
            }
            // Counts without a pose are as good as no reply.
            self.rest_after(now - begin);
            if now >= begin + LOST_NS {
                return Err(LinkError::Other("its encoders show what no pose has").into());
            }
        }
    }

    fn check_ready(&self) -> Result<(), DeviceError> {
        match self.state {
            State::Ready => Ok(()),
            State::Waiting => Err(FalconError::NotReady.into()),
            State::Closed => Err(DeviceError::Closed { device: NAME }),
        }
    }

    /// What `result` is; a failure takes the force away for good.
    fn or_stop<T>(&mut self, result: Result<T, FalconError>) -> Result<T, DeviceError> {
        if result.is_err() {
            self.state = State::Waiting;
            self.command.motors = [0; 3];
            let _ = self.exchange.send(&self.command);
        }
        Ok(result?)
    }
}

impl HapticDevice for Falcon {
    fn name(&self) -> &str {
        NAME
    }

    fn pacing(&self) -> Pacing {
        Pacing::Device
    }

    fn prepare(&mut self, tell: &mut dyn FnMut(&str) -> ControlFlow<()>) -> Result<(), DeviceError> {
        match self.state {
            State::Ready => Ok(()),
            State::Closed => Err(DeviceError::Closed { device: NAME }),
            State::Waiting => {
                self.start(&mut |text| {
                    let _ = tell(text);
                })?;
                Ok(self.home(tell)?)
            }
        }
    }

    fn read(&mut self, _time_s: f64) -> Result<ToolState, DeviceError> {
        self.check_ready()?;
        let located = self.locate_next();
        let reply = self.or_stop(located)?;
        let position = self.place + self.options.offset;
        Ok(ToolState {
            // The encoders are read when the command comes; how long the reply takes does not matter.
            velocity: self.velocity.update(self.sent_ns as f64 * 1e-9, position),
            buttons: self.buttons.update(reply.buttons).into(),
            ..ToolState::at(position)
        })
    }

    fn write(&mut self, wrench: GatedWrench, dt_s: f64) -> Result<(), DeviceError> {
        self.check_ready()?;
        if dt_s > 0.0 {
            self.gain = (self.gain + dt_s / RETURN_S).min(1.0);
        }
        let torques = self.kinematics.torques(self.place, wrench.force() * self.gain);
        let scale = self.kinematics.geometry().counts_per_nm;
        self.command.motors = torques.map_or([0; 3], |torques| motor_counts(torques, scale));
        let sent = self.send();
        self.or_stop(sent)
    }

    fn close(&mut self) {
        if self.state == State::Closed {
            return;
        }
        self.state = State::Closed;
        self.command = Command { homing: self.command.homing, ..Command::default() };
        for _ in 0..LAST_COMMANDS {
            let sent = self.exchange.send(&self.command);
            let until = self.exchange.line.now_ns() + RESEND_NS;
            if sent.and_then(|()| self.exchange.reply(until)).is_err() {
                break;
            }
        }
        self.exchange.line.close();
    }
}

impl Drop for Falcon {
    fn drop(&mut self) {
        self.close();
    }
}

fn homing_text(homed: u8) -> String {
    let mark = |bit: u8| if homed & bit != 0 { "found" } else { "-" };
    format!(
        "pull the grip all the way out, then push it straight in; marks: top {}, right {}, left {}",
        mark(1),
        mark(2),
        mark(4)
    )
}

fn far(from: [i16; 3], to: [i16; 3]) -> bool {
    from.into_iter().zip(to).any(|(a, b)| a.abs_diff(b) > STILL_COUNTS)
}

/// Buttons that do not chatter.
#[derive(Clone, Copy, Debug, Default)]
struct Buttons {
    stable: u8,
    newest: u8,
    same: u8,
}

impl Buttons {
    /// Takes what a reply says, and gives what counts.
    fn update(&mut self, buttons: u8) -> u8 {
        self.same = if buttons == self.newest { self.same.saturating_add(1) } else { 1 };
        self.newest = buttons;
        if self.same >= SAME_REPLIES {
            self.stable = buttons;
        }
        self.stable
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buttons_do_not_chatter() {
        let mut buttons = Buttons::default();
        let told = [1, 0, 1, 1, 1, 1, 0, 1, 0, 0, 0].map(|now| buttons.update(now));
        assert_eq!(told, [0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 0]);
    }
}
