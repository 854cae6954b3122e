//! The servo's half of a coupling: from local models to one force without steps.

use crate::{CouplingKind, LocalModel, ToolState, Wrench};

/// Makes the wrench of each tick from the newest local model. Thread: servo; no allocation, no lock.
///
/// Where the coupling blends, what a new model changes at once is taken off again and given back over one fluid frame, so
/// that the force has no step, however late or early or different the model is.
#[derive(Clone, Debug)]
pub struct Rendering {
    blends: bool,
    /// What the last model gave beyond the newest, when that came.
    step: Wrench,
    /// What left at the last tick.
    last: Wrench,
}

impl Rendering {
    /// The servo's half of a coupling of this kind.
    pub fn new(kind: CouplingKind) -> Self {
        Self { blends: kind == CouplingKind::Local, step: Wrench::ZERO, last: Wrench::ZERO }
    }

    /// The wrench on a tool in this state at `time_s`; `fresh` says that `model` is new at this tick.
    pub fn tick(&mut self, model: &LocalModel, fresh: bool, tool: &ToolState, time_s: f64) -> Wrench {
        let now = model.evaluate(tool);
        if !self.blends {
            return now;
        }
        if fresh && model.frame > 1 {
            self.step = self.last - now;
        }
        let share = (time_s - model.published_s) / model.frame_s;
        // An age that is no number leaves nothing over.
        let left = if share < 1.0 { 1.0 - share.max(0.0) } else { 0.0 };
        self.last = now + self.step * left;
        self.last
    }
}
