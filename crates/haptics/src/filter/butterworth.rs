//! Butterworth low pass: flat pass band, sections of second order through the bilinear transform with its
//! cutoff pre-warped, so that it is exact. Source: S. Butterworth, "On the theory of filter amplifiers",
//! Experimental Wireless 7 (1930); A. V. Oppenheim and R. W. Schafer, "Discrete-time signal processing", ch.
//! 7.

use crate::Wrench;
use std::f64::consts::{PI, TAU};

/// One section of first or second order, transposed direct form II, with a gain of 1 at rest.
#[derive(Clone, Debug)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
    state: [Wrench; 2],
}

impl Section {
    /// Second order with denominator s² + `damping` s + 1; `warp` = tan(π fc / fs).
    fn second(warp: f64, damping: f64) -> Self {
        let square = warp * warp;
        let norm = 1.0 / (1.0 + damping * warp + square);
        let b = [square * norm, 2.0 * square * norm, square * norm];
        let a = [2.0 * (square - 1.0) * norm, (1.0 - damping * warp + square) * norm];
        Self { b, a, state: [Wrench::ZERO; 2] }
    }

    /// First order with denominator s + 1.
    fn first(warp: f64) -> Self {
        let norm = 1.0 / (1.0 + warp);
        let b = [warp * norm, warp * norm, 0.0];
        Self { b, a: [(warp - 1.0) * norm, 0.0], state: [Wrench::ZERO; 2] }
    }

    /// The state that a constant `sample` would leave after for ever.
    fn settle(&mut self, sample: Wrench) {
        let second = sample * (self.b[2] - self.a[1]);
        self.state = [sample * (self.b[1] - self.a[0]) + second, second];
    }

    fn step(&mut self, x: Wrench) -> Wrench {
        let y = x * self.b[0] + self.state[0];
        self.state[0] = x * self.b[1] - y * self.a[0] + self.state[1];
        self.state[1] = x * self.b[2] - y * self.a[1];
        y
    }

    /// |H| at `angle` = 2π f / fs.
    fn gain(&self, angle: f64) -> f64 {
        let size = |c: [f64; 3]| {
            let (sin, cos) = angle.sin_cos();
            let (sin2, cos2) = (2.0 * angle).sin_cos();
            (c[0] + c[1] * cos + c[2] * cos2).hypot(c[1] * sin + c[2] * sin2)
        };
        size(self.b) / size([1.0, self.a[0], self.a[1]])
    }
}

/// A chain of sections.
#[derive(Clone, Debug)]
pub(super) struct Butterworth {
    sections: Box<[Section]>,
    delay_s: f64,
    primed: bool,
}

impl Butterworth {
    /// `cutoff_hz` and `order` must have been checked.
    pub(super) fn new(cutoff_hz: f64, order: usize, rate_hz: f64) -> Self {
        let warp = (PI * cutoff_hz / rate_hz).tan();
        let dampings: Vec<f64> = (0..order / 2).map(|k| damping(k, order)).collect();
        let single = order % 2;
        let mut sections: Vec<Section> = dampings.iter().map(|d| Section::second(warp, *d)).collect();
        sections.extend((0..single).map(|_| Section::first(warp)));
        // The analogue group delay at rest is the sum of the dampings; the transform stretches it by 1/(2
        // warp).
        let samples = (dampings.iter().sum::<f64>() + single as f64) / (2.0 * warp);
        Self { sections: sections.into_boxed_slice(), delay_s: samples / rate_hz, primed: false }
    }

    /// Forgets what went through.
    pub(super) fn reset(&mut self) {
        self.primed = false;
    }

    /// The first sample counts as having been there for ever.
    pub(super) fn step(&mut self, sample: Wrench) -> Wrench {
        if !self.primed {
            self.sections.iter_mut().for_each(|section| section.settle(sample));
            self.primed = true;
        }
        self.sections.iter_mut().fold(sample, |x, section| section.step(x))
    }

    /// Group delay at 0 Hz, s.
    pub(super) fn delay_s(&self) -> f64 {
        self.delay_s
    }

    /// Amplitude that is left at `frequency_hz`.
    pub(super) fn gain(&self, frequency_hz: f64, rate_hz: f64) -> f64 {
        self.sections.iter().map(|section| section.gain(TAU * frequency_hz / rate_hz)).product()
    }
}

/// 1/Q of pole pair `k` of `order` poles spread evenly over the left half of the unit circle.
fn damping(k: usize, order: usize) -> f64 {
    2.0 * (PI * (2 * k + 1) as f64 / (2 * order) as f64).sin()
}
