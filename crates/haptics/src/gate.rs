//! The safety gate: the last thing that a force passes before a hand feels it.

use crate::{FaultSet, GateSettings, GatedWrench, RangeError, Wrench};
use glam::DVec3;

#[cfg(test)]
mod tests;

/// Longest tick that counts, s: after a pause the force still comes back step by step, not at once.
pub const MAX_TICK_S: f64 = 0.01;

/// How old the fluid's data is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelAge {
    /// Time since the newest local model was published, s; infinite while there is none. Negative counts as
    /// 0, NaN as infinite.
    pub age_s: f64,
    /// Time between fluid frames, s; what is not positive and finite counts as 0, so that any age is stale.
    pub frame_s: f64,
}

impl ModelAge {
    /// Data that is never stale: for forces that need no fluid.
    pub const FRESH: Self = Self { age_s: 0.0, frame_s: 0.0 };

    /// No data yet.
    pub const MISSING: Self = Self { age_s: f64::INFINITY, frame_s: 0.0 };

    fn is_stale(self, hold_frames: f64) -> bool {
        let frame_s = if self.frame_s.is_finite() { self.frame_s.max(0.0) } else { 0.0 };
        self.age_s.is_nan() || self.age_s > hold_frames * frame_s
    }
}

/// Makes every wrench safe, whatever comes in. For each tick, in this order:
///
/// 1. A fault that latches, given or found (a wanted wrench that is not finite), means zero at once, and zero
///    until [`clear_faults`](Self::clear_faults): no slew limit holds it up.
/// 2. Force and torque are cut to their largest size, each for itself; their directions stay.
/// 3. One gain between 0 and 1 multiplies both. It rises to 1 in `ramp_in_s` while the data is fresh, and falls
///    to 0 in `stale_fade_s` while it is stale; it begins at 0. So there is no jump at a start, at stale data or
///    when data comes back.
/// 4. Their change since the last tick is cut to the largest slew times the tick.
///
/// A tick that is not positive and finite counts as 0: the wrench stays as it was, faults still act. One
/// above [`MAX_TICK_S`] counts as that for slew and ramp, and whole for the fade. Limits that are lowered
/// while a force is up act at once: the size matters more than the slew, but it shrinks and no more.
#[derive(Clone, Debug)]
pub struct SafetyGate {
    settings: GateSettings,
    sent: Wrench,
    gain: f64,
    latched: FaultSet,
    newest: FaultSet,
}

impl SafetyGate {
    /// A gate that has given nothing yet: its first ticks ramp in.
    ///
    /// # Errors
    /// [`RangeError`] if a setting is outside its range.
    pub fn new(settings: GateSettings) -> Result<Self, RangeError> {
        settings.check()?;
        let (latched, newest) = (FaultSet::NONE, FaultSet::NONE);
        Ok(Self { settings, sent: Wrench::ZERO, gain: 0.0, latched, newest })
    }

    /// Its settings.
    pub fn settings(&self) -> &GateSettings {
        &self.settings
    }

    /// Takes new settings from the next tick on. Does not allocate.
    ///
    /// # Errors
    /// [`RangeError`] if one is outside its range; the old ones then stay.
    pub fn set_settings(&mut self, settings: GateSettings) -> Result<(), RangeError> {
        settings.check()?;
        self.settings = settings;
        Ok(())
    }

    /// Brings its limits down to these sizes, N and N·m, for as long as they are above; those of
    /// [`set_settings`](Self::set_settings) take their place. What is no number counts as 0.
    pub fn lower(&mut self, max_force_n: f64, max_torque_nm: f64) {
        let lower = |own: f64, limit: f64| if limit >= 0.0 { own.min(limit) } else { 0.0 };
        self.settings.max_force_n = lower(self.settings.max_force_n, max_force_n);
        self.settings.max_torque_nm = lower(self.settings.max_torque_nm, max_torque_nm);
    }

    /// One tick: `wanted` is the wrench that was computed, `age` that of the fluid's data, `faults` what the
    /// caller knows of, `dt_s` the time since the last tick, s.
    pub fn pass(&mut self, wanted: Wrench, age: &ModelAge, faults: FaultSet, dt_s: f64) -> GatedWrench {
        let stale = age.is_stale(self.settings.stale_hold_frames);
        let found =
            FaultSet::NON_FINITE_FORCE.when(!wanted.is_finite()) | FaultSet::STALE.when(stale) | faults;
        self.newest = found;
        self.latched |= found.latching();
        if !self.latched.is_empty() {
            self.sent = Wrench::ZERO;
            self.gain = 0.0;
            return GatedWrench::ZERO;
        }
        let dt_s = if dt_s.is_finite() { dt_s.max(0.0) } else { 0.0 };
        self.advance_gain(stale, dt_s);
        self.sent = self.limit(wanted, dt_s.min(MAX_TICK_S));
        GatedWrench::new(self.sent)
    }

    /// A tick without force: it is taken off at once, and no slew limit holds it up. What comes next rises from zero.
    pub fn release(&mut self) -> GatedWrench {
        self.sent = Wrench::ZERO;
        GatedWrench::ZERO
    }

    /// Every latched fault, and whatever else the newest tick found.
    pub fn faults(&self) -> FaultSet {
        self.latched | self.newest
    }

    /// The faults that hold the force at zero.
    pub fn latched(&self) -> FaultSet {
        self.latched
    }

    /// Share of the wanted wrench that is let through, 0 to 1.
    pub fn gain(&self) -> f64 {
        self.gain
    }

    /// Forgets the latched faults, and `raised`, which may have come and gone since the newest tick; the force then
    /// ramps in as after a start. A cause that is still there latches again at the next tick.
    pub fn clear_faults(&mut self, raised: FaultSet) {
        if !raised.latching().is_empty() {
            self.sent = Wrench::ZERO;
            self.gain = 0.0;
        }
        self.latched = FaultSet::NONE;
        self.newest = FaultSet::NONE;
    }

    fn advance_gain(&mut self, stale: bool, dt_s: f64) {
        let change = if stale {
            -share(dt_s, self.settings.stale_fade_s)
        } else {
            share(dt_s.min(MAX_TICK_S), self.settings.ramp_in_s)
        };
        self.gain = (self.gain + change).clamp(0.0, 1.0);
    }

    /// The wanted wrench, with its gain and within every limit.
    fn limit(&mut self, wanted: Wrench, dt_s: f64) -> Wrench {
        let s = self.settings;
        let force = Limits { size: s.max_force_n, change: s.max_slew_n_per_s * dt_s };
        let torque = Limits { size: s.max_torque_nm, change: s.max_torque_slew_nm_per_s * dt_s };
        Wrench {
            force: self.limit_vector(wanted.force, self.sent.force, force),
            torque: self.limit_vector(wanted.torque, self.sent.torque, torque),
        }
    }

    fn limit_vector(&mut self, wanted: DVec3, sent: DVec3, limits: Limits) -> DVec3 {
        // Cut before the gain, so that the ramp of a force above the limit takes its full time.
        let target = shorten(wanted, limits.size);
        let change = target * self.gain - sent;
        let slewed = shorten(change, limits.change);
        self.newest |=
            FaultSet::FORCE_LIMITED.when(target != wanted) | FaultSet::SLEW_LIMITED.when(slewed != change);
        shorten(sent + slewed, limits.size)
    }
}

/// What a vector may do in one tick.
#[derive(Clone, Copy)]
struct Limits {
    size: f64,
    change: f64,
}

/// Share of a ramp of `length_s` that `dt_s` is; a ramp without length is over at once.
fn share(dt_s: f64, length_s: f64) -> f64 {
    if length_s > 0.0 { dt_s / length_s } else { 1.0 }
}

/// `vector`, with its direction, no longer than `limit`; right for any finite numbers, also where the square
/// of a length would overflow or vanish.
fn shorten(vector: DVec3, limit: f64) -> DVec3 {
    let peak = vector.abs().max_element();
    if peak == 0.0 {
        return DVec3::ZERO;
    }
    // A few roundings inside the limit, so that the length as anyone computes it is never above.
    let limit = limit * (1.0 - 4.0 * f64::EPSILON);
    let unit = vector / peak;
    let length = unit.length();
    if peak * length <= limit { vector } else { unit * (limit / length) }
}
