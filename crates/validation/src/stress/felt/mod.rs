//! Steadiness of what a hand feels: random hands, devices, gains, filters and rates under mishaps of all kinds, and what must
//! hold whatever happens.
//!
//! A trial draws a scene (`scenery.rs`) and runs it in closed loop with a fluid that comes late, not at all, or spoilt
//! (`pace.rs`, `spoiler.rs`), a device that jumps or says what is no number, and changes from outside (`mishap.rs`). At each
//! tick the `judge.rs` looks: force finite and within its limits of size and slew, zero on a fault and on stale data, up again
//! slowly; the coupling gives no energy of its own. In the end, when all is quiet, the force must be back.

mod judge;
mod mishap;
mod pace;
mod scenery;
mod spoiler;

use super::dice::Dice;
use crate::felt::ClosedLoop;
use glam::DVec3;
use hapflow_engine::{BackendKind, SceneError, SessionOptions, open_backend};
use hapflow_haptics::{FaultSet, ToolState};
use judge::Judge;
use mishap::{Mishap, What};
use pace::RoughPace;
use scenery::Scenery;
use spoiler::Spoiler;

/// The servo's period, s.
const TICK_S: f64 = 1e-3;
/// Time after which somebody takes back a fault, s.
const CLEARED_S: [f64; 2] = [0.02, 0.3];

/// Runs the trial of `seed`.
///
/// # Errors
/// What went wrong.
pub(super) fn run(seed: u64) -> Result<(), String> {
    let mut dice = Dice::new(seed);
    let scenery = Scenery::draw(&mut dice);
    let mut trial = Trial::open(scenery, dice).map_err(|error| format!("it is refused: {error}"))?;
    trial.ticks().map_err(|what| format!("{:.3} s: {what} ({})", trial.time_s, trial.story()))
}

/// A trial under way.
struct Trial {
    scenery: Scenery,
    dice: Dice,
    felt: ClosedLoop,
    pace: RoughPace,
    spoiler: Spoiler,
    judge: Judge,
    /// What is still to come, the last first.
    mishaps: Vec<Mishap>,
    /// What was.
    told: Vec<String>,
    time_s: f64,
    /// By how much the device has jumped, m.
    shift: DVec3,
    /// Ticks for which the device says nothing of use.
    blind: usize,
    /// When a fault is taken back, s.
    clear_s: Option<f64>,
}

impl Trial {
    fn open(scenery: Scenery, mut dice: Dice) -> Result<Self, SceneError> {
        let spoiler = Spoiler::default();
        let fluid = spoiler.wrap(open_backend(&scenery.scene, &scenery.scene.fluid_config(1))?);
        let options = SessionOptions { backend: Some(fluid), ..SessionOptions::hosted() };
        let felt = ClosedLoop::open(&scenery.scene, options)?;
        let mishaps = mishap::draw(&mut dice);
        Ok(Self {
            pace: RoughPace::new(scenery.scene.run.fluid_hz, dice.of("pace")),
            judge: Judge::new(&scenery.scene),
            felt,
            spoiler,
            mishaps,
            told: Vec::new(),
            time_s: 0.0,
            shift: DVec3::ZERO,
            blind: 0,
            clear_s: None,
            scenery,
            dice,
        })
    }

    /// What the trial is about.
    fn story(&self) -> String {
        let s = &self.scenery.scene;
        let backend = if s.run.backend == BackendKind::Cpu { "particles" } else { "jet" };
        let first = format!(
            "{}, {}, {backend}, {:.0} Hz, gain {:.2}",
            s.run.coupling.name(),
            s.filter(),
            s.run.fluid_hz,
            s.tool.force_scale
        );
        std::iter::once(first).chain(self.told.iter().cloned()).collect::<Vec<_>>().join("; ")
    }

    fn ticks(&mut self) -> Result<(), String> {
        let end = mishap::LAST_S + mishap::STALL_S + self.scenery.quiet_s();
        while self.time_s < end {
            let dt_s = self.mishaps()? + TICK_S;
            self.time_s += dt_s;
            self.tick(dt_s)?;
        }
        self.judge.recovered(self.felt.servo.newest())
    }

    /// Lets happen what is due, and says for how long the servo is held up by it, s.
    fn mishaps(&mut self) -> Result<f64, String> {
        let mut held_up = 0.0;
        while let Some(mishap) = self.mishaps.pop_if(|m| m.at_s <= self.time_s) {
            self.told.push(format!("{:.3} s: {:?}", mishap.at_s, mishap.what));
            match mishap.what {
                What::Jump(by) => self.shift += by,
                What::Blind(ticks) => self.blind = ticks,
                What::Pause(seconds) => held_up += seconds,
                What::Stall(seconds) => self.pace.stall(mishap.at_s + seconds),
                What::Spoilt(how) => self.spoiler.spoil(how),
                What::Stop => self.felt.session.control().emergency_stop(),
                What::Gain(factor) => self.set_gain(factor)?,
                What::Limit(share) => self.lower_limit(share)?,
            }
        }
        self.pace.calm(self.time_s > mishap::LAST_S);
        if self.clear_s.take_if(|at| *at <= self.time_s).is_some() {
            self.felt.session.control().clear_faults();
        }
        Ok(held_up)
    }

    fn set_gain(&mut self, factor: f64) -> Result<(), String> {
        let gain = (self.scenery.scene.tool.force_scale * factor).min(100.0);
        self.judge.force_scale = gain;
        let set = self.felt.session.set("tool.force_scale", &hapflow_engine::Value::Number(gain));
        set.map_err(|error| error.to_string())
    }

    fn lower_limit(&mut self, share: f64) -> Result<(), String> {
        let gate = &mut self.judge.gate;
        gate.max_force_n *= share;
        let lowered = self.felt.session.control().limit_force(gate.max_force_n, gate.max_torque_nm);
        lowered.map_err(|error| error.to_string())
    }

    fn tick(&mut self, dt_s: f64) -> Result<(), String> {
        self.pace.advance(&mut self.felt.fluid, self.time_s);
        let blind = self.blind > 0;
        self.blind = self.blind.saturating_sub(1);
        let shift = self.shift;
        let seen = |tool: ToolState| {
            let position = if blind { DVec3::NAN } else { tool.position + shift };
            ToolState { position, ..tool }
        };
        let wrench = self.felt.tick(self.time_s, dt_s, seen).map_err(|error| error.to_string())?;
        let servo = &self.felt.servo;
        self.judge.look(wrench.wrench(), servo.newest(), servo.model(), dt_s, self.felt.hand.truth())?;
        if blind && !servo.newest().faults.contains(FaultSet::NON_FINITE_INPUT) {
            return Err("a place that is no number is taken".into());
        }
        let latched = !servo.newest().faults.latching().is_empty();
        if latched && self.clear_s.is_none() {
            self.clear_s = Some(self.time_s + self.dice.within(CLEARED_S[0], CLEARED_S[1]));
        }
        Ok(())
    }
}
