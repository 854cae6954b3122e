//! How a fluid keeps pace with a servo on the virtual clock.

use crate::{FluidUnit, Scene};

/// Ends of frames that round past a tick still belong to it, s.
const SLACK_S: f64 = 1e-9;

/// Computes each frame when its tool path is complete, and publishes it as much later as a machine would take to
/// compute it: no free look ahead.
#[derive(Clone, Debug)]
pub struct VirtualPace {
    fluid_hz: f64,
    /// Time that a frame takes to compute, in frames, 0 to 1.
    delay: f64,
    computed: u64,
    published: u64,
}

impl VirtualPace {
    /// The pace of `scene`, from the first tick on.
    pub fn new(scene: &Scene) -> Self {
        Self { fluid_hz: scene.run.fluid_hz, delay: scene.run.fluid_delay, computed: 0, published: 0 }
    }

    /// Brings the fluid to `time_s`; true if a model was published.
    pub fn advance(&mut self, fluid: &mut FluidUnit, time_s: f64) -> bool {
        let mut news = false;
        loop {
            let next = self.end_s(self.computed + 1, 0.0);
            if self.published < self.computed {
                let due = self.end_s(self.computed, self.delay);
                if due > time_s + SLACK_S {
                    return news;
                }
                fluid.publish(due);
                self.published = self.computed;
                news = true;
            } else if next <= time_s + SLACK_S {
                fluid.compute(next);
                self.computed += 1;
            } else {
                return news;
            }
        }
    }

    /// `late` frames after the end of frame `k`, s. Divided, not summed up.
    fn end_s(&self, k: u64, late: f64) -> f64 {
        (k as f64 + late) / self.fluid_hz
    }
}
