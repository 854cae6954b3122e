//! One-euro filter: a first-order low pass whose cutoff rises with the rate of change.
//!
//! Source: G. Casiez, N. Roussel and D. Vogel, "1€ filter: a simple speed-based low-pass filter for noisy
//! input in interactive systems", CHI 2012, doi:10.1145/2207676.2208639. Here the speed is the length of the
//! vector's rate of change, so that the answer does not depend on how the axes lie.

use crate::Wrench;
use glam::DVec3;
use std::f64::consts::TAU;

/// Cutoff of the rate of change, Hz: the paper's own choice.
const RATE_CUTOFF_HZ: f64 = 1.0;

/// The filter of one vector.
#[derive(Clone, Copy, Debug, Default)]
struct Channel {
    value: DVec3,
    rate: DVec3,
}

impl Channel {
    fn step(&mut self, sample: DVec3, min_cutoff_hz: f64, beta: f64, rate_hz: f64) -> DVec3 {
        let rate = (sample - self.value) * rate_hz;
        self.rate += (rate - self.rate) * blend(RATE_CUTOFF_HZ, rate_hz);
        let cutoff = min_cutoff_hz + beta * self.rate.length();
        self.value += (sample - self.value) * blend(cutoff, rate_hz);
        self.value
    }
}

/// Force and torque, each filtered as one vector.
#[derive(Clone, Debug)]
pub(super) struct OneEuro {
    min_cutoff_hz: f64,
    beta: f64,
    rate_hz: f64,
    /// Force and torque; nothing before the first sample.
    channels: Option<[Channel; 2]>,
}

impl OneEuro {
    /// The numbers must have been checked.
    pub(super) fn new(min_cutoff_hz: f64, beta: f64, rate_hz: f64) -> Self {
        Self { min_cutoff_hz, beta, rate_hz, channels: None }
    }

    /// Forgets what went through.
    pub(super) fn reset(&mut self) {
        self.channels = None;
    }

    /// The first sample comes out as it is.
    pub(super) fn step(&mut self, sample: Wrench) -> Wrench {
        let start = |value| Channel { value, rate: DVec3::ZERO };
        let [force, torque] = self.channels.get_or_insert([start(sample.force), start(sample.torque)]);
        Wrench {
            force: force.step(sample.force, self.min_cutoff_hz, self.beta, self.rate_hz),
            torque: torque.step(sample.torque, self.min_cutoff_hz, self.beta, self.rate_hz),
        }
    }

    /// Group delay at 0 Hz while the force rests, s: the time constant. Less while it changes.
    pub(super) fn delay_s(&self) -> f64 {
        1.0 / (TAU * self.min_cutoff_hz)
    }

    /// Amplitude that is left at `frequency_hz` of a signal too small to raise the cutoff.
    pub(super) fn gain(&self, frequency_hz: f64) -> f64 {
        let alpha = blend(self.min_cutoff_hz, self.rate_hz);
        let (sin, cos) = (TAU * frequency_hz / self.rate_hz).sin_cos();
        alpha / (1.0 - (1.0 - alpha) * cos).hypot((1.0 - alpha) * sin)
    }
}

/// Share of the new sample: 1/(1 + τ/T), τ = 1/(2π cutoff).
fn blend(cutoff_hz: f64, rate_hz: f64) -> f64 {
    let tau = 1.0 / (TAU * cutoff_hz);
    1.0 / (1.0 + tau * rate_hz)
}
