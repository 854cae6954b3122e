//! How a force is spread over frequencies.

use glam::DVec3;
use serde_json::json;
use std::f64::consts::TAU;

/// Bands an octave, and the lowest band's middle, Hz.
const BANDS: f64 = 3.0;
const LOWEST_HZ: f64 = 4.0;
/// Highest frequency, Hz: half of a value a millisecond.
const HIGHEST_HZ: f64 = 500.0;

/// A force, band by band.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Of what: what was sent in the steady jet, or its error in a crossing.
    pub of: &'static str,
    /// Coupling and filter.
    pub way: String,
    /// Fluid frames a second, Hz.
    pub fluid_hz: f64,
    /// Middle of each third of an octave, Hz, and the force's root of the mean square in it, N.
    pub bands: Vec<[f64; 2]>,
}

impl Spectrum {
    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        let column = |k: usize| self.bands.iter().map(|b| b[k]).collect::<Vec<_>>();
        json!({
            "quantity": "spectrum",
            "of": self.of,
            "way": self.way,
            "fluid_hz": self.fluid_hz,
            "hz": column(0),
            "rms_N": column(1),
        })
    }
}

/// Thirds of an octave of a series of one value a millisecond, without its mean.
pub(super) fn bands(series: &[DVec3]) -> Vec<[f64; 2]> {
    let n = series.len().max(1) as f64;
    let mean = series.iter().sum::<DVec3>() / n;
    let share = |k: f64| {
        let turn = TAU * k / n;
        let (mut cosine, mut sine) = (DVec3::ZERO, DVec3::ZERO);
        for (t, force) in series.iter().enumerate() {
            let (s, c) = (turn * t as f64).sin_cos();
            cosine += (*force - mean) * c;
            sine += (*force - mean) * s;
        }
        2.0 * (cosine.length_squared() + sine.length_squared()) / (n * n)
    };
    let half = 2.0_f64.powf(0.5 / BANDS);
    let middles = (0..).map(|k| LOWEST_HZ * 2.0_f64.powf(f64::from(k) / BANDS));
    let per_hz = n * 1e-3;
    let band = |middle: f64| {
        let (first, last) = ((middle / half * per_hz).ceil(), (middle * half * per_hz).ceil());
        let sum: f64 = (first as usize..last as usize).map(|k| share(k as f64)).sum();
        [middle, sum.sqrt()]
    };
    middles.take_while(|middle| middle * half < HIGHEST_HZ).map(band).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_is_in_its_band_and_nowhere_else() {
        let sine: Vec<_> = (0..1000).map(|t| DVec3::Y * (1.0 + (TAU * 0.05 * f64::from(t)).sin())).collect();
        for [middle, rms] in bands(&sine) {
            let there = (middle / 50.0).log2().abs() < 0.5 / BANDS;
            let expected = if there { 0.5_f64.sqrt() } else { 0.0 };
            assert!((rms - expected).abs() < 1e-6, "{middle} Hz: {rms}");
        }
    }
}
