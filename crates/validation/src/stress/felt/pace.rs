//! A fluid's thread as a busy machine runs it: late, and sometimes not at all.

use crate::stress::dice::Dice;
use hapflow_engine::FluidUnit;

/// Longest that a frame takes, in frames, where it is late.
const LATEST: f64 = 5.0;
/// Ends of frames that round past a tick still belong to it, s.
const SLACK_S: f64 = 1e-9;

/// Steps a fluid as the session's own thread does, on the virtual clock: a frame at a time, and those that it was too slow
/// for are skipped.
#[derive(Clone, Debug)]
pub(super) struct RoughPace {
    period_s: f64,
    dice: Dice,
    /// Shares of frames that come late, and that never come.
    late: f64,
    lost: f64,
    /// Until when the next frame hangs, s.
    stalled_s: f64,
    /// End of the next frame, s.
    end_s: f64,
    /// When the computed one is handed over, s.
    due_s: Option<f64>,
}

impl RoughPace {
    pub fn new(fluid_hz: f64, mut dice: Dice) -> Self {
        let period_s = 1.0 / fluid_hz;
        let (late, lost) = (dice.within(0.0, 0.5), dice.within(0.0, 0.2));
        Self { period_s, dice, late, lost, stalled_s: 0.0, end_s: period_s, due_s: None }
    }

    /// Hangs in the next frame until `time_s`.
    pub fn stall(&mut self, time_s: f64) {
        self.stalled_s = time_s;
    }

    /// From now on every frame comes in time, if `calm`.
    pub fn calm(&mut self, calm: bool) {
        if calm {
            (self.late, self.lost) = (0.0, 0.0);
        }
    }

    /// Brings the fluid to `time_s`.
    pub fn advance(&mut self, fluid: &mut FluidUnit, time_s: f64) {
        loop {
            if let Some(due_s) = self.due_s {
                if due_s > time_s + SLACK_S {
                    return;
                }
                self.due_s = None;
                self.hand_over(fluid, time_s);
            } else if self.end_s <= time_s + SLACK_S {
                fluid.compute(self.end_s);
                self.due_s = Some((time_s + self.cost_s()).max(self.stalled_s));
            } else {
                return;
            }
        }
    }

    fn hand_over(&mut self, fluid: &mut FluidUnit, time_s: f64) {
        if !self.dice.chance(self.lost) {
            fluid.publish(time_s);
        }
        self.end_s += self.period_s;
        let behind = ((time_s - self.end_s) / self.period_s).floor().max(0.0);
        self.end_s += behind * self.period_s;
    }

    /// How long a frame takes to compute, s.
    fn cost_s(&mut self) -> f64 {
        let most = if self.dice.chance(self.late) { LATEST } else { 0.9 };
        self.dice.within(0.0, most) * self.period_s
    }
}
