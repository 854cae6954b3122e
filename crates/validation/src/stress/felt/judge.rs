//! What must hold at every tick.

use glam::DVec3;
use hapflow_devices::{HandSettings, PathPoint};
use hapflow_engine::{Scene, ServoReport};
use hapflow_haptics::{CouplingKind, FaultSet, GateSettings, LocalModel, MAX_TICK_S, Wrench};
use std::collections::VecDeque;
use std::f64::consts::TAU;

/// Energy that a coupling may give by itself in half a second, J, and that time in ticks.
const OWN_J: f64 = 1e-3;
const WINDOW: usize = 500;
/// Rounding, of one.
const ROUNDING: f64 = 1e-9;
/// Factor on the hand's own acceleration that the added mass may answer to, and accelerations that encoders feign, 1/s².
const INERTIA: f64 = 3.0;
const FEIGNED: f64 = 1e4;

/// Watches over one trial.
#[derive(Debug)]
pub(super) struct Judge {
    /// The limits as they stand.
    pub gate: GateSettings,
    /// The factor on the fluid's force as it stands.
    pub force_scale: f64,
    local: bool,
    frame_s: f64,
    encoder_step_m: f64,
    map_scale: f64,
    /// What a force does to the device before its velocity is known to have changed, J/N².
    unforeseen: f64,
    /// The last tick.
    sent: Wrench,
    own: DVec3,
    /// The strongest own force, N.
    strongest: f64,
    hand: Option<PathPoint>,
    /// Highest acceleration of the hand so far, m/s².
    acceleration: f64,
    started_s: Option<f64>,
    /// Since when the data is too old, s.
    stale_s: Option<f64>,
    /// When the force was last at zero by order, s.
    zero_s: f64,
    /// Own energy of the coupling after each of the last ticks, J.
    work: VecDeque<f64>,
}

/// Work that a newton squared does on the device of `hand` before it is seen to move, J: F² t²/m, with the tick and the lag of
/// the velocity's estimate. Scene frame.
fn unforeseen(hand: &HandSettings, map_scale: f64) -> f64 {
    let lag_s = if hand.encoder_step_m > 0.0 { 1.0 / (TAU * hand.velocity_cutoff_hz) } else { 0.0 };
    map_scale * (1e-3 + lag_s).powi(2) / (hand.device_mass_kg + hand.hand_mass_kg)
}

impl Judge {
    pub fn new(scene: &Scene) -> Self {
        Self {
            gate: scene.gate,
            force_scale: scene.tool.force_scale,
            local: scene.run.coupling == CouplingKind::Local,
            frame_s: 1.0 / scene.run.fluid_hz,
            encoder_step_m: scene.hand.encoder_step_m,
            map_scale: scene.mapping.scale,
            unforeseen: unforeseen(&scene.hand, scene.mapping.scale),
            sent: Wrench::ZERO,
            own: DVec3::ZERO,
            strongest: 0.0,
            hand: None,
            acceleration: 0.0,
            started_s: None,
            stale_s: None,
            zero_s: 0.0,
            work: VecDeque::from([0.0]),
        }
    }

    /// Says what is wrong with a tick of `dt_s` seconds that sent `sent` (device frame), if anything.
    pub fn look(
        &mut self,
        sent: Wrench,
        report: &ServoReport,
        model: &LocalModel,
        dt_s: f64,
        hand: PathPoint,
    ) -> Result<(), String> {
        self.finite(&sent, report)?;
        self.within_limits(&sent)?;
        self.silent(&sent, report, model)?;
        self.slewed(&sent, report, dt_s)?;
        self.ramped(&sent, report.time_s)?;
        let last = self.hand.replace(hand).unwrap_or(hand);
        self.acceleration = self.acceleration.max(hand.velocity.distance(last.velocity) / dt_s);
        self.explained(report, model)?;
        self.passive(report, (hand.position - last.position) * self.map_scale)?;
        self.sent = sent;
        Ok(())
    }

    fn finite(&self, sent: &Wrench, report: &ServoReport) -> Result<(), String> {
        let parts = [sent, &report.raw, &report.filtered, &report.sent];
        let numbers = [report.own_energy_j, report.held_back_n, report.own.length(), report.time_s];
        let all = parts.iter().all(|w| w.is_finite()) && numbers.iter().all(|n| n.is_finite());
        if all && report.tool.is_finite() { Ok(()) } else { Err(format!("not finite: {report:?}")) }
    }

    fn within_limits(&self, sent: &Wrench) -> Result<(), String> {
        let (force, torque) = (sent.force.length(), sent.torque.length());
        if force <= self.gate.max_force_n && torque <= self.gate.max_torque_nm {
            return Ok(());
        }
        Err(format!(
            "{force} N and {torque} N m, most {} and {}",
            self.gate.max_force_n, self.gate.max_torque_nm
        ))
    }

    /// Zero on a fault, and where the data is too old.
    fn silent(&mut self, sent: &Wrench, report: &ServoReport, model: &LocalModel) -> Result<(), String> {
        let now = report.time_s;
        let started = *self.started_s.get_or_insert(now);
        let since = if model.frame == 0 { started } else { model.published_s };
        let stale = now - since > self.gate.stale_hold_frames * self.frame_s;
        self.stale_s = self.stale_s.filter(|_| stale).or(stale.then_some(now));
        // The fade, as long as the slew limit lets it be.
        let slow = |size: f64, slew: f64| size / slew;
        let held = slow(self.gate.max_force_n, self.gate.max_slew_n_per_s)
            .max(slow(self.gate.max_torque_nm, self.gate.max_torque_slew_nm_per_s));
        let faded = self.stale_s.is_some_and(|from| now - from > self.gate.stale_fade_s + held + MAX_TICK_S);
        let latched = !report.faults.latching().is_empty();
        if (faded || latched) && *sent != Wrench::ZERO {
            return Err(format!("{} N, though {} and stale: {faded}", sent.force.length(), report.faults));
        }
        // The gain is zero at the end of the fade, whatever the slew limit does.
        if latched || self.stale_s.is_some_and(|from| now - from > self.gate.stale_fade_s + MAX_TICK_S) {
            self.zero_s = now;
        }
        Ok(())
    }

    fn slewed(&self, sent: &Wrench, report: &ServoReport, dt_s: f64) -> Result<(), String> {
        if !report.faults.latching().is_empty() {
            return Ok(());
        }
        let dt_s = dt_s.min(MAX_TICK_S);
        let step = |to: DVec3, from: DVec3, most: f64, size: f64| {
            // A limit that is lowered acts at once, and only shrinks.
            let from = from.clamp_length_max(size);
            let step = to.distance(from);
            (step > most * dt_s + ROUNDING).then(|| format!("a step of {step:.3e}, most {:.3e}", most * dt_s))
        };
        let g = &self.gate;
        let force = step(sent.force, self.sent.force, g.max_slew_n_per_s, g.max_force_n);
        let torque = step(sent.torque, self.sent.torque, g.max_torque_slew_nm_per_s, g.max_torque_nm);
        force.or(torque).map_or(Ok(()), Err)
    }

    /// After a zero it comes up slowly.
    fn ramped(&self, sent: &Wrench, now: f64) -> Result<(), String> {
        let share = if self.gate.ramp_in_s > 0.0 {
            // The tick of the zero itself may have begun the ramp.
            ((now - self.zero_s + MAX_TICK_S) / self.gate.ramp_in_s).min(1.0)
        } else {
            1.0
        };
        let slack = if self.sent == Wrench::ZERO { ROUNDING } else { self.sent.force.length() };
        if sent.force.length() <= (share * self.gate.max_force_n).max(slack) + ROUNDING {
            return Ok(());
        }
        let since = now - self.zero_s;
        Err(format!("{} N {since:.4} s after a zero, of {} N", sent.force.length(), self.gate.max_force_n))
    }

    /// What is rendered is the model, what the coupling says that it adds, and the inertia of what goes along.
    fn explained(&self, report: &ServoReport, model: &LocalModel) -> Result<(), String> {
        let law = model.evaluate(&report.tool).force * self.force_scale;
        let rest = report.raw.force - law - report.own;
        let felt = INERTIA * self.acceleration + FEIGNED * self.encoder_step_m + 1.0;
        let most = self.force_scale * model.added_mass * self.map_scale * felt;
        let rounding = ROUNDING * (1.0 + law.length() + report.own.length());
        if rest.length() <= most + rounding {
            return Ok(());
        }
        Err(format!(
            "{:.3e} N that nothing explains, of {:.3e} N; most {most:.3e}",
            rest.length(),
            law.length()
        ))
    }

    /// The coupling gives no energy of its own on the `way` that the hand has truly gone in the last tick, m, scene frame.
    fn passive(&mut self, report: &ServoReport, way: DVec3) -> Result<(), String> {
        let own = std::mem::replace(&mut self.own, report.own);
        self.strongest = self.strongest.max(own.length());
        // Where the gate cuts a force, there is no telling what the coupling's part of it is.
        if report.raw.force.length() > self.gate.max_force_n {
            (self.own, self.strongest) = (DVec3::ZERO, 0.0);
            self.work = VecDeque::from([0.0]);
            return Ok(());
        }
        let sum = self.work.back().copied().unwrap_or(0.0) + own.dot(way);
        self.work.push_back(sum);
        if self.work.len() > WINDOW {
            self.work.pop_front();
        }
        let given = sum - self.work.iter().copied().fold(sum, f64::min);
        let f = self.strongest;
        // Within a step of the encoder nobody sees the motion; and what the old and the new model's force does at once.
        let most = OWN_J + f * self.encoder_step_m * self.map_scale + 2.0 * f * f * self.unforeseen;
        if !self.local || given <= most {
            return Ok(());
        }
        Err(format!("the coupling itself gave {given:.3e} J in half a second, most {most:.3e}"))
    }

    /// Says what is wrong at the end, when all is quiet.
    pub fn recovered(&self, report: &ServoReport) -> Result<(), String> {
        let still = report.faults.latching() | report.faults.intersection(FaultSet::STALE);
        if !still.is_empty() {
            return Err(format!("{still} at the end"));
        }
        // The last bit of a very slow slew apart, what is felt is sent.
        let wanted = report.filtered.force.clamp_length_max(self.gate.max_force_n);
        let there = (report.sent.force - wanted).length() <= ROUNDING * (1.0 + wanted.length());
        if there || report.faults.contains(FaultSet::SLEW_LIMITED) {
            return Ok(());
        }
        Err(format!("{} N at the end, and {} N are wanted", report.sent.force.length(), wanted.length()))
    }
}
