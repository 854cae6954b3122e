//! A window that slides over the newest taps.

use super::{TapPlace, WindowKind};
use crate::Wrench;
use std::f64::consts::TAU;

/// Weighted mean of the newest taps: Σ w F / Σ w.
#[derive(Clone, Debug)]
pub(super) struct Fir {
    /// Normalised to a sum of 1, the oldest tap's first.
    weights: Box<[f64]>,
    /// A ring: `oldest` is the tap that the next one replaces.
    history: Box<[Wrench]>,
    oldest: usize,
    place: TapPlace,
    /// The newest answer; nothing before the first tap.
    value: Option<Wrench>,
}

impl Fir {
    /// `kind` and `taps` must have been checked.
    pub(super) fn new(kind: WindowKind, taps: usize, place: TapPlace) -> Self {
        let mut weights = kind.weights(taps).into_boxed_slice();
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        let history = vec![Wrench::ZERO; weights.len()].into_boxed_slice();
        Self { weights, history, oldest: 0, place, value: None }
    }

    /// Forgets every tap.
    pub(super) fn reset(&mut self) {
        self.value = None;
    }

    /// Takes the sample as a tap if it is one, and answers with the newest mean.
    pub(super) fn step(&mut self, sample: Wrench, new_frame: bool) -> Wrench {
        if self.place == TapPlace::Fluid && !new_frame {
            return self.value.unwrap_or(sample);
        }
        self.push(sample);
        let value = self.mean();
        self.value = Some(value);
        value
    }

    /// The first tap fills the history: a constant then comes out at once, even where the newest weight is 0.
    fn push(&mut self, sample: Wrench) {
        if self.value.is_none() {
            self.history.fill(sample);
        } else if let Some(slot) = self.history.get_mut(self.oldest) {
            *slot = sample;
            self.oldest = (self.oldest + 1) % self.history.len();
        }
    }

    fn mean(&self) -> Wrench {
        let (newer, older) = self.history.split_at(self.oldest);
        let mut sum = Wrench::ZERO;
        for (weight, tap) in self.weights.iter().zip(older.iter().chain(newer)) {
            sum += *tap * *weight;
        }
        sum
    }

    /// Time between taps, s, of a servo of `servo_rate_hz` and a fluid frame of `frame_s`.
    fn tap_s(&self, servo_rate_hz: f64, frame_s: f64) -> f64 {
        match self.place {
            TapPlace::Servo => 1.0 / servo_rate_hz,
            TapPlace::Fluid => frame_s,
        }
    }

    /// Half the length of the window, s: a symmetric window delays every frequency alike.
    pub(super) fn delay_s(&self, servo_rate_hz: f64, frame_s: f64) -> f64 {
        (self.weights.len() - 1) as f64 / 2.0 * self.tap_s(servo_rate_hz, frame_s)
    }

    /// Amplitude that is left at `frequency_hz`.
    pub(super) fn gain(&self, frequency_hz: f64, servo_rate_hz: f64, frame_s: f64) -> f64 {
        let step = TAU * frequency_hz * self.tap_s(servo_rate_hz, frame_s);
        let (mut re, mut im) = (0.0, 0.0);
        for (n, weight) in self.weights.iter().enumerate() {
            let (sin, cos) = (step * n as f64).sin_cos();
            re += weight * cos;
            im += weight * sin;
        }
        re.hypot(im)
    }
}
