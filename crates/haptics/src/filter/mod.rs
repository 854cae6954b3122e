//! Filters of a wrench at the servo's rate.
//!
//! The thesis's own filter is `bartlett-hann:11@fluid`; the others are there to be compared with it.

mod butterworth;
mod error;
mod fir;
mod one_euro;
mod spec;
mod window;

#[cfg(test)]
mod tests;

pub use error::FilterError;
pub use spec::{
    DEFAULT_BUTTERWORTH_ORDER, DEFAULT_SERVO_RATE_HZ, FILTER_PRESETS, FilterSpec, MAX_BUTTERWORTH_ORDER,
    MAX_TAPS, TapPlace,
};
pub use window::WindowKind;

use crate::Wrench;
use butterworth::Butterworth;
use fir::Fir;
use one_euro::OneEuro;

/// A filter at work on one wrench, built from a [`FilterSpec`].
///
/// Every filter has a gain of 1 at rest and takes its first sample as if it had been there for ever: a
/// constant comes out at once, without a start-up droop, even through a window whose newest tap has weight 0.
/// A sample that is not finite is handed on as it is, so that the gate sees it, and is not kept: the filter
/// goes on from what it held before.
#[derive(Clone, Debug)]
pub struct Filter {
    stage: Stage,
    servo_rate_hz: f64,
}

#[derive(Clone, Debug)]
enum Stage {
    None,
    Fir(Fir),
    Butterworth(Butterworth),
    OneEuro(OneEuro),
}

impl Filter {
    /// A filter that has seen nothing yet. Allocates what it will ever need.
    ///
    /// # Errors
    /// [`FilterError`] if a number of `spec` is outside its range for this rate, or `servo_rate_hz` outside
    /// 100 to 100 000.
    pub fn new(spec: &FilterSpec, servo_rate_hz: f64) -> Result<Self, FilterError> {
        spec.check(servo_rate_hz)?;
        let stage = match *spec {
            FilterSpec::None => Stage::None,
            FilterSpec::Window { kind, taps, place } => Stage::Fir(Fir::new(kind, taps, place)),
            FilterSpec::Butterworth { cutoff_hz, order } => {
                Stage::Butterworth(Butterworth::new(cutoff_hz, order, servo_rate_hz))
            }
            FilterSpec::OneEuro { min_cutoff_hz, beta } => {
                Stage::OneEuro(OneEuro::new(min_cutoff_hz, beta, servo_rate_hz))
            }
        };
        Ok(Self { stage, servo_rate_hz })
    }

    /// One servo tick: takes the newest wrench, gives the filtered one.
    ///
    /// `new_frame` is true on the tick at which a new fluid frame's wrench has arrived: only then does a
    /// window `@fluid` take a tap; on the other ticks it repeats its value, and before its first frame it
    /// hands the sample on. The other filters take every sample. Costs one multiplication a tap.
    pub fn step(&mut self, sample: Wrench, new_frame: bool) -> Wrench {
        if !sample.is_finite() {
            return sample;
        }
        let filtered = match &mut self.stage {
            Stage::None => sample,
            Stage::Fir(fir) => fir.step(sample, new_frame),
            Stage::Butterworth(butterworth) => butterworth.step(sample),
            Stage::OneEuro(one_euro) => one_euro.step(sample),
        };
        // Samples near the end of the number range can overflow: that must not stay inside.
        if !filtered.is_finite() {
            self.reset();
        }
        filtered
    }

    /// Forgets every sample.
    pub fn reset(&mut self) {
        match &mut self.stage {
            Stage::None => {}
            Stage::Fir(fir) => fir.reset(),
            Stage::Butterworth(butterworth) => butterworth.reset(),
            Stage::OneEuro(one_euro) => one_euro.reset(),
        }
    }

    /// Group delay at 0 Hz, s: how far a slow force comes late. `frame_s` is the time between fluid frames,
    /// s, and counts for windows `@fluid` alone. That a frame's force is held until the next one is not in
    /// it; nor does it know how much faster a one-euro filter is while the force changes.
    pub fn delay_s(&self, frame_s: f64) -> f64 {
        match &self.stage {
            Stage::None => 0.0,
            Stage::Fir(fir) => fir.delay_s(self.servo_rate_hz, frame_s),
            Stage::Butterworth(butterworth) => butterworth.delay_s(),
            Stage::OneEuro(one_euro) => one_euro.delay_s(),
        }
    }

    /// Amplitude that is left of a sine of `frequency_hz`, 1 at 0 Hz. `frame_s` as for
    /// [`delay_s`](Self::delay_s); that of a one-euro filter holds for signals too small to raise its cutoff.
    pub fn gain(&self, frequency_hz: f64, frame_s: f64) -> f64 {
        match &self.stage {
            Stage::None => 1.0,
            Stage::Fir(fir) => fir.gain(frequency_hz, self.servo_rate_hz, frame_s),
            Stage::Butterworth(butterworth) => butterworth.gain(frequency_hz, self.servo_rate_hz),
            Stage::OneEuro(one_euro) => one_euro.gain(frequency_hz),
        }
    }
}
