//! Numbers that say how a force feels: ripple, lag, size. Series are sampled at 1 kHz.

use glam::DVec3;
use std::f64::consts::PI;

/// Below this a force is felt as a push, above as ripple, Hz.
pub const RIPPLE_ABOVE_HZ: f64 = 20.0;

/// Mean of a series.
pub fn mean(series: &[DVec3]) -> DVec3 {
    if series.is_empty() { DVec3::ZERO } else { series.iter().sum::<DVec3>() / series.len() as f64 }
}

/// Root of the mean square above [`RIPPLE_ABOVE_HZ`].
pub fn ripple_rms(series: &[DVec3]) -> f64 {
    let slow = low_pass(series, RIPPLE_ABOVE_HZ, 1000.0);
    let square: f64 = series.iter().zip(&slow).map(|(a, b)| a.distance_squared(*b)).sum();
    if series.is_empty() { 0.0 } else { (square / series.len() as f64).sqrt() }
}

/// Low pass without lag: a Butterworth of order 2 forwards and backwards (−6 dB at `cutoff_hz`).
pub fn low_pass(series: &[DVec3], cutoff_hz: f64, rate_hz: f64) -> Vec<DVec3> {
    let mut out = series.to_vec();
    for _ in 0..2 {
        biquad(&mut out, cutoff_hz, rate_hz);
        out.reverse();
    }
    out
}

fn biquad(series: &mut [DVec3], cutoff_hz: f64, rate_hz: f64) {
    let k = (PI * cutoff_hz / rate_hz).tan();
    let norm = 1.0 / (1.0 + std::f64::consts::SQRT_2 * k + k * k);
    let (b0, a1, a2) =
        (k * k * norm, 2.0 * (k * k - 1.0) * norm, (1.0 - std::f64::consts::SQRT_2 * k + k * k) * norm);
    let Some(&first) = series.first() else { return };
    // It starts as if the first value had been there for ever.
    let (mut x1, mut x2, mut y1, mut y2) = (first, first, first, first);
    for value in series {
        let x = *value;
        let y = b0 * (x + 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
        (x2, x1, y2, y1) = (x1, x, y1, y);
        *value = y;
    }
}

/// Longest lag that is looked for, samples.
const MAX_LAG: usize = 250;

/// By how much `late` lags behind `early` (samples of `dt` seconds): where their cross-correlation peaks, with a
/// parabola through the peak. 0 when either does not move.
pub fn lag_s(early: &[DVec3], late: &[DVec3], dt: f64) -> f64 {
    let n = early.len().min(late.len());
    if n < 4 * MAX_LAG {
        return 0.0;
    }
    let (a, b) = (mean(&early[..n]), mean(&late[..n]));
    let correlation = |lag: usize| {
        let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
        for k in MAX_LAG..n {
            let (x, y) = (early[k - lag] - a, late[k] - b);
            ab += x.dot(y);
            aa += x.dot(x);
            bb += y.dot(y);
        }
        if aa * bb > 0.0 { ab / (aa * bb).sqrt() } else { 0.0 }
    };
    let values: Vec<f64> = (0..MAX_LAG).map(correlation).collect();
    let best = (0..MAX_LAG).max_by(|&i, &j| values[i].total_cmp(&values[j])).unwrap_or(0);
    if values[best] <= 0.0 {
        return 0.0;
    }
    if best == 0 || best + 1 == MAX_LAG {
        return best as f64 * dt;
    }
    let (l, c, r) = (values[best - 1], values[best], values[best + 1]);
    let curve = l - 2.0 * c + r;
    let shift = if curve < 0.0 { 0.5 * (l - r) / curve } else { 0.0 };
    (best as f64 + shift) * dt
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(hz: f64, amplitude: f64, delay_s: f64, n: usize) -> Vec<DVec3> {
        (0..n).map(|k| DVec3::Y * amplitude * (2.0 * PI * hz * (k as f64 * 1e-3 - delay_s)).sin()).collect()
    }

    #[test]
    fn ripple_is_what_is_fast() {
        let fast = sine(100.0, 0.2, 0.0, 5000);
        assert!((ripple_rms(&fast) / (0.2 / 2.0_f64.sqrt()) - 1.0).abs() < 0.02);
        assert!(ripple_rms(&sine(1.0, 1.0, 0.0, 5000)) < 0.005);
        assert_eq!(ripple_rms(&[]), 0.0);
        // −6 dB at the edge: half the amplitude goes either way.
        let edge = low_pass(&sine(20.0, 1.0, 0.0, 8000), 20.0, 1000.0);
        let peak = edge[3000..5000].iter().map(|v| v.y).fold(0.0, f64::max);
        assert!((peak - 0.5).abs() < 0.01, "{peak}");
    }

    #[test]
    fn lag_is_found_to_a_fraction_of_a_sample() {
        for delay in [0.0, 0.0052, 0.0337, 0.1] {
            let lag = lag_s(&sine(1.3, 1.0, 0.0, 6000), &sine(1.3, 0.7, delay, 6000), 1e-3);
            assert!((lag - delay).abs() < 1e-3, "{delay}: {lag}");
        }
        assert_eq!(lag_s(&vec![DVec3::ONE; 3000], &vec![DVec3::ONE; 3000], 1e-3), 0.0);
    }
}
