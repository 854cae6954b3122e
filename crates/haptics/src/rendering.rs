//! The servo's half of a coupling: from local models to one force without steps.

use crate::added_mass::AddedMass;
use crate::passivity::Passivity;
use crate::{CouplingKind, Forecast, LocalModel, ToolState, Wrench};
use glam::DVec3;

/// Ticks of which the hand's place and velocity are made.
const TICKS: usize = 40;
/// What leaves at a tick acts until the next: in the mean half a tick later, s.
const AHEAD_S: f64 = 0.5e-3;

/// Makes the wrench of each tick from the newest local model. Thread: servo; no allocation, no lock.
///
/// Where the coupling blends, what a new model changes at once is taken off again and given back over one fluid frame, so that the
/// force has no step, however late or early or different the model is.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// Where the hand is, if the coupling looks at it that closely.
    hand: Option<Forecast<TICKS>>,
    /// The fluid that goes along with the tool.
    carried: AddedMass,
    /// The model of the last tick.
    model: LocalModel,
    /// What the models before gave beyond it, when it came.
    step: Wrench,
    /// Watches what the step does.
    passivity: Passivity,
    /// Size of what was taken off it at the last tick, N.
    held_back_n: f64,
}

impl Rendering {
    /// The servo's half of a coupling of this kind.
    pub fn new(kind: CouplingKind) -> Self {
        let hand = (kind == CouplingKind::Local).then(|| Forecast::new(ToolState::default()));
        Self {
            hand,
            carried: AddedMass::default(),
            model: LocalModel::default(),
            step: Wrench::ZERO,
            passivity: Passivity::default(),
            held_back_n: 0.0,
        }
    }

    /// The wrench on a tool in this state at `time_s`, with a factor of `scale` on the fluid's force; `fresh` says that
    /// `model` is new at this tick.
    pub fn tick(
        &mut self,
        model: &LocalModel,
        fresh: bool,
        tool: &ToolState,
        time_s: f64,
        scale: f64,
    ) -> Wrench {
        let Some(hand) = &mut self.hand else { return model.evaluate(tool) * scale };
        hand.take(time_s, tool);
        if !fresh && self.model.acts_not() && self.step == Wrench::ZERO {
            // Out of reach of all fluid nothing is reckoned; what goes along begins anew.
            self.carried = AddedMass::default();
            return self.own(Wrench::ZERO, tool, time_s, scale);
        }
        // At the start and after a jump, until it is known how the hand moves, the tool as it is, and nothing goes along.
        let smooth = if hand.knows() {
            hand.at(time_s + AHEAD_S, 1.0)
        } else {
            self.carried = AddedMass::default();
            *tool
        };
        let acceleration = self.carried.follow(&smooth, time_s);
        if fresh {
            self.take(model, &smooth, time_s);
        }
        let inertia = Wrench::from_force(acceleration * -self.model.added_mass);
        let law = self.model.evaluate(tool);
        let beyond = self.model.evaluate(&smooth) - law;
        (law + inertia) * scale + self.own(beyond, tool, time_s, scale)
    }

    /// What the coupling renders beyond the newest model on the tool, as far as it is passive: `beyond`, which comes of the
    /// smoothed tool, and the step.
    fn own(&mut self, beyond: Wrench, tool: &ToolState, time_s: f64, scale: f64) -> Wrench {
        let factor = self.left(time_s) * scale;
        let wanted = beyond * scale + self.step * factor;
        let force = self.passivity.admit(wanted.force, tool.position, tool.velocity, time_s);
        let held_back = wanted.force - force;
        self.held_back_n = held_back.length();
        // What was taken off does not come back when the tool turns round.
        if factor > 0.0 {
            let most = self.step.force.length();
            self.step.force -= (held_back / factor).clamp_length_max(most);
        }
        Wrench { force, ..wanted }
    }

    /// Force that the coupling itself added to that of the newest model at the last tick, N.
    pub fn own_force(&self) -> DVec3 {
        self.passivity.force()
    }

    /// Energy that the coupling itself has given to the hand beyond what it took since its lowest, J.
    pub fn own_energy_j(&self) -> f64 {
        self.passivity.rise_j()
    }

    /// Force that was taken off at the last tick so that it gives no more, N.
    pub fn held_back_n(&self) -> f64 {
        self.held_back_n
    }

    /// Goes over to `model` without a step.
    fn take(&mut self, model: &LocalModel, tool: &ToolState, time_s: f64) {
        let before = self.model.evaluate(tool) + self.step * self.left(time_s);
        self.step = if self.model.frame == 0 { Wrench::ZERO } else { before - model.evaluate(tool) };
        self.model = *model;
    }

    /// Share of the step that is left.
    fn left(&self, time_s: f64) -> f64 {
        let share = (time_s + AHEAD_S - self.model.published_s) / self.model.frame_s;
        // An age that is no number leaves nothing over.
        if share < 1.0 { 1.0 - share.max(0.0) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The water that goes along is not torn with the tool to where the device suddenly says that it is.
    #[test]
    fn a_jump_does_not_pull_at_what_goes_along() {
        let mut rendering = Rendering::new(CouplingKind::Local);
        let model = LocalModel { frame: 1, frame_s: 0.01, added_mass: 0.05, ..LocalModel::default() };
        for n in 0..200 {
            let place = if n < 100 { DVec3::ZERO } else { DVec3::X * 0.3 };
            let force = rendering.tick(&model, n == 0, &ToolState::at(place), f64::from(n) * 1e-3, 1.0).force;
            assert_eq!(force, DVec3::ZERO, "tick {n}");
        }
    }

    /// Before it knows how the hand moves, it does not take it to be at rest: damping would be missing.
    #[test]
    fn damping_acts_from_the_first_tick_on() {
        let mut rendering = Rendering::new(CouplingKind::Local);
        let node = crate::LawNode {
            force: glam::Vec3::ZERO,
            by_velocity: glam::Mat3::from_diagonal(glam::Vec3::splat(-2.0)),
        };
        let law = crate::Law::tabulate(DVec3::ZERO, DVec3::ZERO, 0.01, |_| node);
        let model = LocalModel { frame: 1, frame_s: 0.01, law, ..LocalModel::default() };
        for n in 0..30 {
            let time_s = f64::from(n) * 1e-3;
            let tool = ToolState { velocity: DVec3::X * 0.1, ..ToolState::at(DVec3::X * 0.1 * time_s) };
            let force = rendering.tick(&model, n == 0, &tool, time_s, 1.0).force;
            assert!((force.x + 0.2).abs() < 1e-6, "tick {n}: {force}");
        }
    }
}
