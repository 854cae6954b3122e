//! The hand at an emulated Falcon, and the arms that it moves.

use crate::falcon::{Command, FalconError, Kinematics, Reply, torques_of};
use crate::{
    AtEnd, DeviceError, HandPreset, HandSettings, HapticDevice, Segment, SimulatedHand, TargetScript,
};
use glam::DVec3;
use hapflow_haptics::check_range;

/// Where the grip is when the device is plugged in, m.
const START: DVec3 = DVec3::new(0.0, 0.0, 0.115);
/// The middle of the workspace, m.
const MIDDLE: DVec3 = DVec3::new(0.0, 0.0, 0.125);
/// Angles at which the arms find their marks on their way in, degrees. An assumption: nobody has published them.
const MARKS_DEG: [f64; 3] = [58.3, 56.9, 57.6];
/// The grip's weight, kg, within what is guessed of the real one; and its dry friction, N, likewise.
const GRIP_KG: f64 = 0.12;
const FRICTION_N: f64 = 0.3;
/// Standard gravity, m/s².
const GRAVITY: f64 = 9.80665;
/// How long a command acts if no other follows, ns. An assumption: it is known to be short.
const HOLD_NS: u64 = 50_000_000;

/// A person who homes the device when it asks for that, and then does as a script says.
pub struct EmulatedHand {
    kinematics: Kinematics,
    hand: SimulatedHand,
    powered: bool,
    /// Weight that nobody but the motors carries, N.
    weight: DVec3,
    /// When the device first asked to be homed, ns: the script's beginning.
    begun_ns: Option<u64>,
    commanded_ns: u64,
    motors: [i16; 3],
    /// The arms' counts now, as from their marks, and what the encoders show less.
    counts: [f64; 3],
    base: [f64; 3],
    /// The counts at the last command that asked for marks.
    seen: [f64; 3],
    homed: u8,
    buttons: u8,
}

impl EmulatedHand {
    /// A hand that follows `script` once it has homed the device; places in the Falcon's frame. Without `powered` the
    /// supply is not plugged in: the arms neither move nor find their marks.
    ///
    /// # Errors
    /// [`DeviceError`] if the script cannot be followed, or the arms cannot hold the grip.
    pub fn new(kinematics: Kinematics, script: &[Segment], powered: bool) -> Result<Self, DeviceError> {
        let to = |z: f64, duration_s| Segment::MoveTo { position: DVec3::Z * z, duration_s };
        let homing = [Segment::Hold { duration_s: 0.5 }, to(0.172, 1.0), to(0.1, 1.5), to(MIDDLE.z, 1.0)];
        let script = TargetScript::new(START, &[&homing, script].concat(), AtEnd::Hold)?;
        let hand = SimulatedHand::new(HandSettings::preset(HandPreset::Normal), script)?;
        let counts = counts(&kinematics, START).ok_or(FalconError::NoPose)?;
        Ok(Self {
            kinematics,
            hand,
            powered,
            weight: DVec3::ZERO,
            begun_ns: None,
            commanded_ns: 0,
            motors: [0; 3],
            counts,
            base: counts,
            seen: counts,
            homed: 0,
            buttons: 0,
        })
    }

    /// How long after it was asked the device is homed and in the middle of its workspace, s.
    pub const HOMING_S: f64 = 4.0;

    /// Where the grip truly is, m.
    pub fn place(&self) -> DVec3 {
        self.hand.truth().position
    }

    /// The force that the motors give, N.
    pub fn felt(&self) -> DVec3 {
        let torques = torques_of(self.motors, self.kinematics.geometry().counts_per_nm);
        self.kinematics.force(self.place(), torques).unwrap_or_default()
    }

    /// The hand lets go of the grip, on which `load_kg` hang, kg, 0 to 5: its weight and that of the load draw at it, and its dry
    /// friction holds it back.
    ///
    /// # Errors
    /// [`DeviceError::Setting`] for another load.
    pub fn let_go(&mut self, load_kg: f64) -> Result<(), DeviceError> {
        let free = HandSettings::preset(HandPreset::Free);
        let device_mass_kg = free.device_mass_kg + check_range("load_kg", load_kg, 0.0, 5.0)?;
        let settings = HandSettings { device_mass_kg, device_friction_n: FRICTION_N, ..free };
        self.hand = SimulatedHand::new(settings, TargetScript::new(self.place(), &[], AtEnd::Hold)?)?;
        self.weight = DVec3::NEG_Y * (GRAVITY * (GRIP_KG + load_kg));
        Ok(())
    }

    /// Presses these buttons.
    pub fn press(&mut self, buttons: u8) {
        self.buttons = buttons;
    }

    /// Loses its marks, as after a failure of its supply.
    pub fn unhome(&mut self) {
        self.homed = 0;
    }

    /// Lives on until `now`.
    pub fn live(&mut self, now: u64) {
        if !self.powered {
            return;
        }
        if now.saturating_sub(self.commanded_ns) > HOLD_NS {
            self.motors = [0; 3];
        }
        self.hand.feel(self.felt() + self.weight);
        let since = self.begun_ns.map_or(0, |begun| now.saturating_sub(begun));
        let _ = self.hand.read(since as f64 * 1e-9);
        if let Some(counts) = counts(&self.kinematics, self.place()) {
            self.counts = counts;
        }
    }

    /// Takes a command at `now`, and answers it.
    pub(super) fn obey(&mut self, command: &Command, now: u64) -> Reply {
        self.live(now);
        self.commanded_ns = now;
        self.motors = command.motors;
        if command.homing {
            self.begun_ns.get_or_insert(now);
            self.find_marks();
        }
        let shown = |arm: usize| (self.counts[arm] - self.base[arm]).round() as i16;
        Reply { encoders: [0, 1, 2].map(shown), homed: self.homed, buttons: self.buttons }
    }

    fn find_marks(&mut self) {
        let before = std::mem::replace(&mut self.seen, self.counts);
        let marks = self.kinematics.geometry().counts(MARKS_DEG.map(f64::to_radians));
        for arm in 0..3 {
            if before[arm] > marks[arm] && self.counts[arm] <= marks[arm] && self.homed & 1 << arm == 0 {
                self.homed |= 1 << arm;
                self.base[arm] = 0.0;
            }
        }
    }
}

fn counts(kinematics: &Kinematics, place: DVec3) -> Option<[f64; 3]> {
    kinematics.inverse(place).ok().map(|angles| kinematics.geometry().counts(angles))
}
