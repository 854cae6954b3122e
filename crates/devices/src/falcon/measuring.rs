//! Readings for a calibration, taken at a Falcon that is homed, with a person's help.

use crate::falcon::calibration::{GRAVITY, LARGEST_LOAD_KG, LEAST_LOAD_KG, LoadReading};
use crate::falcon::{Falcon, FalconError, Kinematics};
use crate::{AtEnd, DeviceError, HapticDevice, Segment, TargetScript};
use glam::DVec3;
use hapflow_haptics::{
    FaultSet, GateSettings, GatedWrench, ModelAge, SafetyGate, ToolState, Wrench, check_range,
};
use std::ops::ControlFlow;

/// A grip that is held still moves no arm by more counts than this, some 0.3 mm,
const STILL_COUNTS: f64 = 8.0;
/// for so long, s.
const STILL_S: f64 = 1.0;

/// How long the force takes to come up and the grip to the middle, both in the hand, and a person to take hold again, s.
const HANDS_S: f64 = 3.0;
/// There it swings up and down by so much, m, in so long, s: over whole swings friction and inertia drop out of the mean.
const SWING_M: f64 = 0.005;
const SWING_S: f64 = 1.0;
/// The grip is carried by a spring (N/m), a damper (N·s/m) and what the spring has pulled so far (N/m·s).
const STIFFNESS: f64 = 300.0;
const DAMPING: f64 = 6.0;
const PATIENCE: f64 = 600.0;
/// Most that is carried, N.
const MAX_CARRIED_N: f64 = 8.0;
/// Farther from its path than this the grip has got away, m.
const AWAY_M: f64 = 0.04;
/// A reading counts once so many swings in a row agree to this share of the load's weight,
const SWINGS: usize = 3;
const AGREEMENT: f64 = 0.01;
/// and, with the load, differ from those without it by at least this share of it.
const HUNG: f64 = 0.3;

/// What a person is to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// Hold the grip still.
    HoldStill,
    /// Hold the grip loosely while the motors take it over.
    HandOver,
    /// Let go of the grip, which the motors carry.
    LetGo,
    /// Hang this on the grip, kg, and let go.
    Hang {
        /// The load, kg.
        load_kg: f64,
    },
    /// Take hold of the grip, since the motors are about to let go.
    TakeHold,
}

impl std::fmt::Display for Request {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::HoldStill => f.write_str("hold the grip still"),
            Self::HandOver => {
                f.write_str("hold the grip loosely, about in the middle: the motors take it over")
            }
            Self::LetGo => {
                f.write_str("let go of the grip: the motors carry it, and swing it up and down a little")
            }
            Self::Hang { load_kg } => {
                write!(f, "hang {load_kg} kg on the grip, so that it hangs freely, and let go")
            }
            Self::TakeHold => f.write_str("take hold of the grip: the force goes off"),
        }
    }
}

/// Gets what a person is to do, tick by tick, and may break it off.
pub type Ask<'a> = dyn FnMut(Request) -> ControlFlow<()> + 'a;

impl Falcon {
    /// The mean encoder counts over a second in which the grip was held still. Gives no force. Thread: main, waits for the
    /// person.
    ///
    /// # Errors
    /// [`DeviceError`] if the device is lost or not homed, or it was broken off.
    pub fn measure_held(&mut self, ask: &mut Ask<'_>) -> Result<[f64; 3], DeviceError> {
        let (mut begin_s, mut first, mut sums, mut count) = (self.now_s(), None, DVec3::ZERO, 0.0);
        while count == 0.0 || self.now_s() < begin_s + STILL_S {
            asked(ask, Request::HoldStill)?;
            self.read(0.0)?;
            self.write(GatedWrench::ZERO, 0.0)?;
            let counts = DVec3::from_array(self.stats().encoders.map(f64::from));
            if (counts - *first.get_or_insert(counts)).abs().max_element() > STILL_COUNTS {
                (begin_s, first, sums, count) = (self.now_s(), Some(counts), DVec3::ZERO, 0.0);
            }
            sums += counts;
            count += 1.0;
        }
        Ok((sums / count).to_array())
    }

    /// What the motors give while they carry the bare grip, and then the grip with `load_kg` (0.02 to 0.5 kg) hung on it, as
    /// `kinematics` understands the encoders. Gives force: the grip moves to the middle, and swings there by 5 mm. Thread: main, waits
    /// for the person.
    ///
    /// # Errors
    /// [`DeviceError`] if the load is outside its range, the device is lost or not homed, the grip got away, or it was broken
    /// off. The force is off then.
    pub fn measure_loads(
        &mut self,
        kinematics: &Kinematics,
        load_kg: f64,
        ask: &mut Ask<'_>,
    ) -> Result<[LoadReading; 2], DeviceError> {
        check_range("load (kg)", load_kg, LEAST_LOAD_KG, LARGEST_LOAD_KG)?;
        let measured = self.weigh(kinematics, load_kg, ask);
        let off = self.write(GatedWrench::ZERO, 0.0);
        let readings = measured?;
        off.map(|()| readings)
    }

    fn weigh(
        &mut self,
        kinematics: &Kinematics,
        load_kg: f64,
        ask: &mut Ask<'_>,
    ) -> Result<[LoadReading; 2], DeviceError> {
        let weight = load_kg * GRAVITY * kinematics.geometry().counts_per_nm;
        let mut carrier = Carrier::new(self, kinematics, ask)?;
        carrier.pass(HANDS_S, Request::HandOver)?;
        let bare = carrier.steady(Request::LetGo, weight, None)?;
        let loaded = carrier.steady(Request::Hang { load_kg }, weight, Some(bare))?;
        carrier.pass(HANDS_S, Request::TakeHold)?;
        Ok([LoadReading { pull: bare, load_kg: 0.0 }, LoadReading { pull: loaded, load_kg }])
    }
}

/// Breaks off where the person wants to.
fn asked(ask: &mut Ask<'_>, request: Request) -> Result<(), FalconError> {
    if ask(request).is_break() { Err(FalconError::Stopped) } else { Ok(()) }
}

/// Carries the grip to the middle and then up and down, whatever hangs from it.
struct Carrier<'a, 'b> {
    falcon: &'a mut Falcon,
    kinematics: &'a Kinematics,
    ask: &'a mut Ask<'b>,
    path: TargetScript,
    gate: SafetyGate,
    begin_s: f64,
    last_s: f64,
    /// What it has come to carry, N.
    carried: DVec3,
}

impl<'a, 'b> Carrier<'a, 'b> {
    fn new(
        falcon: &'a mut Falcon,
        kinematics: &'a Kinematics,
        ask: &'a mut Ask<'b>,
    ) -> Result<Self, DeviceError> {
        let start = falcon.read(0.0)?.position;
        falcon.write(GatedWrench::ZERO, 0.0)?;
        let swing =
            Segment::Sine { amplitude: DVec3::Y * SWING_M, frequency_hz: 1.0 / SWING_S, duration_s: 3600.0 };
        let to_middle = Segment::MoveTo { position: falcon.middle(), duration_s: HANDS_S };
        let settings = GateSettings { max_force_n: MAX_CARRIED_N, ramp_in_s: 1.0, ..GateSettings::default() };
        let begin_s = falcon.now_s();
        Ok(Self {
            falcon,
            kinematics,
            ask,
            path: TargetScript::new(start, &[to_middle, swing], AtEnd::Hold)?,
            gate: SafetyGate::new(settings)?,
            begin_s,
            last_s: begin_s,
            carried: DVec3::ZERO,
        })
    }

    /// Carries on for `for_s`, s.
    fn pass(&mut self, for_s: f64, request: Request) -> Result<(), DeviceError> {
        let end_s = self.last_s + for_s;
        while self.last_s < end_s {
            self.tick(request)?;
        }
        Ok(())
    }

    /// The mean pull over some swings, once they agree and, where there is a `bare` pull, differ from that.
    fn steady(&mut self, request: Request, weight: f64, bare: Option<DVec3>) -> Result<DVec3, DeviceError> {
        let mut pulls = [DVec3::NAN; SWINGS];
        loop {
            pulls.rotate_left(1);
            pulls[SWINGS - 1] = self.swing(request)?;
            let mean = pulls.iter().sum::<DVec3>() / SWINGS as f64;
            let agree = pulls.iter().all(|pull| pull.distance(mean) <= AGREEMENT * weight);
            if agree && bare.is_none_or(|bare| mean.distance(bare) >= HUNG * weight) {
                return Ok(mean);
            }
        }
    }

    /// The mean pull over a swing.
    fn swing(&mut self, request: Request) -> Result<DVec3, DeviceError> {
        let (begin_s, mut sum) = (self.last_s, DVec3::ZERO);
        while self.last_s < begin_s + SWING_S {
            let before_s = self.last_s;
            let pull = self.tick(request)?;
            sum += pull * (self.last_s - before_s);
        }
        Ok(sum / (self.last_s - begin_s))
    }

    /// Carries on for a tick; what the motors pull then, if a count were a newton metre, N.
    fn tick(&mut self, request: Request) -> Result<DVec3, DeviceError> {
        asked(self.ask, request)?;
        let state = self.falcon.read(0.0)?;
        let dt_s = self.falcon.now_s() - self.last_s;
        self.last_s += dt_s;
        let force = self.force(&state, dt_s)?;
        let gated = self.gate.pass(Wrench::from_force(force), &ModelAge::FRESH, FaultSet::NONE, dt_s);
        self.falcon.write(gated, dt_s)?;
        let stats = self.falcon.stats();
        let (encoders, motors) = (stats.encoders.map(f64::from), stats.motors.map(f64::from));
        let reading = LoadReading::at(self.kinematics, encoders, motors, 0.0);
        Ok(reading.map_err(|_| FalconError::GotAway)?.pull)
    }

    fn force(&mut self, state: &ToolState, dt_s: f64) -> Result<DVec3, FalconError> {
        let wish = self.path.at(self.last_s - self.begin_s);
        let off = wish.position - state.position;
        if off.length() > AWAY_M {
            return Err(FalconError::GotAway);
        }
        self.carried = (self.carried + off * (PATIENCE * dt_s)).clamp_length_max(MAX_CARRIED_N);
        Ok(self.carried + off * STIFFNESS + (wish.velocity - state.velocity) * DAMPING)
    }
}
