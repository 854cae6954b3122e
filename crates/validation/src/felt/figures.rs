//! From forces to figures. Series are of one value a millisecond.

use crate::stats;
use glam::DVec3;
use hapflow_engine::signal::{RIPPLE_ABOVE_HZ, low_pass};
use std::f64::consts::{PI, TAU};

/// Share of the peak above which the direction of a force is judged.
const DIRECTED: f64 = 0.2;

/// Root of the mean square.
pub(crate) fn rms(series: &[DVec3]) -> f64 {
    (series.iter().map(|v| v.length_squared()).sum::<f64>() / series.len().max(1) as f64).sqrt()
}

/// What is below 20 Hz.
pub(crate) fn slow(series: &[DVec3]) -> Vec<DVec3> {
    low_pass(series, RIPPLE_ABOVE_HZ, 1000.0)
}

/// `a` less `b`.
pub(crate) fn difference(a: &[DVec3], b: &[DVec3]) -> Vec<DVec3> {
    a.iter().zip(b).map(|(a, b)| *a - *b).collect()
}

/// Difference below 20 Hz, over the truth's own size there.
pub(crate) fn force_error(sent: &[DVec3], truth: &[DVec3]) -> f64 {
    rms(&slow(&difference(sent, truth))) / rms(&slow(truth))
}

/// Mean angle between both below 20 Hz where the truth is strong, °.
pub(crate) fn direction_error_deg(sent: &[DVec3], truth: &[DVec3]) -> f64 {
    let (sent, truth) = (slow(sent), slow(truth));
    let peak = truth.iter().map(|f| f.length()).fold(0.0, f64::max);
    let strong = sent.iter().zip(&truth).filter(|(_, t)| t.length() > DIRECTED * peak);
    let angles: Vec<f64> =
        strong.map(|(s, t)| if s.length() > 0.0 { s.angle_between(*t).to_degrees() } else { 90.0 }).collect();
    angles.iter().sum::<f64>() / angles.len().max(1) as f64
}

/// Lag (s, negative for a lead) and relative amplitude of `sent` against `truth` at `hz`, along their direction of
/// largest motion.
pub(crate) fn lag_and_gain(sent: &[DVec3], truth: &[DVec3], hz: f64, along: DVec3) -> [f64; 2] {
    let wave = |series: &[DVec3]| {
        let series: Vec<_> =
            series.iter().enumerate().map(|(n, f)| [1e-3 * n as f64, f.dot(along)]).collect();
        stats::sine(&series, TAU * hz)
    };
    let ([a, b], [c, d]) = (wave(sent), wave(truth));
    let phase = (b.atan2(a) - d.atan2(c) + PI).rem_euclid(TAU) - PI;
    [phase / (TAU * hz), a.hypot(b) / c.hypot(d)]
}

/// By how much `sent` is later than `truth`, negative for a lead, s: the shift at which both differ least, within 0.2 s, with a
/// parabola through the least. Before and after a series its ends go on.
pub(crate) fn shift_s(sent: &[DVec3], truth: &[DVec3]) -> f64 {
    let last = sent.len().min(truth.len()) as i64 - 1;
    let at = |n: i64| sent[n.clamp(0, last) as usize];
    let apart =
        |shift: i64| (0..=last).map(|n| at(n + shift).distance_squared(truth[n as usize])).sum::<f64>();
    let least = |shifts: &mut dyn Iterator<Item = i64>| {
        shifts.map(|s| (s, apart(s))).min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(s, _)| s)
    };
    let near = least(&mut (-200..=200).step_by(8));
    let best = least(&mut (near - 8..=near + 8));
    let [before, here, after] = [-1, 0, 1].map(|step| apart(best + step));
    let curve = before - 2.0 * here + after;
    1e-3 * (best as f64 + if curve > 0.0 { 0.5 * (before - after) / curve } else { 0.0 })
}

/// Size of the step at which `share` of the ticks with a new model stay, N.
pub(crate) fn swap_step(sent: &[DVec3], fresh: &[bool], share: f64) -> f64 {
    let steps = sent.windows(2).zip(&fresh[1..]).filter(|(_, fresh)| **fresh);
    let mut sizes: Vec<f64> = steps.map(|(w, _)| w[0].distance(w[1])).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get((share * sizes.len() as f64) as usize).or(sizes.last()).copied().unwrap_or(0.0)
}

/// Net of ∫ (sent − truth)·v dt, and its largest upswing: what the coupling gave the hand that the fluid did not, J.
pub(crate) fn energy(sent: &[DVec3], truth: &[DVec3], path: &[DVec3]) -> [f64; 2] {
    let (mut sum, mut low, mut up) = (0.0, 0.0_f64, 0.0_f64);
    for ((s, t), way) in sent.iter().zip(truth).zip(path.windows(2)) {
        sum += (*s - *t).dot(way[1] - way[0]);
        low = low.min(sum);
        up = up.max(sum - low);
    }
    [sum, up]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(hz: f64, late_s: f64, size: f64) -> Vec<DVec3> {
        (0..2000)
            .map(|n| DVec3::Y * (1.0 + size * (TAU * hz * (1e-3 * f64::from(n) - late_s)).sin()))
            .collect()
    }

    #[test]
    fn lag_has_a_sign_and_gain_is_a_ratio() {
        for late in [0.004, -0.003] {
            let [lag, gain] = lag_and_gain(&sine(2.0, late, 0.3), &sine(2.0, 0.0, 0.2), 2.0, DVec3::Y);
            assert!((lag - late).abs() < 1e-5 && (gain - 1.5).abs() < 1e-3, "{lag} {gain}");
        }
    }

    #[test]
    fn a_shift_is_found_to_a_fraction_of_a_tick() {
        for late in [-0.0613, 0.0, 0.0042, 0.12] {
            let found = shift_s(&sine(1.3, late, 0.2), &sine(1.3, 0.0, 0.2));
            assert!((found - late).abs() < 3e-3, "{late}: {found}");
        }
    }

    #[test]
    fn errors_of_size_and_direction() {
        let truth = vec![DVec3::Y; 500];
        assert!((force_error(&vec![DVec3::Y * 1.1; 500], &truth) - 0.1).abs() < 1e-9);
        assert!((direction_error_deg(&vec![DVec3::new(1.0, 1.0, 0.0); 500], &truth) - 45.0).abs() < 1e-6);
    }

    #[test]
    fn energy_is_that_of_the_difference() {
        let path: Vec<_> = (0..=100).map(|n| DVec3::X * f64::from(n) * 1e-3).collect();
        let [net, up] = energy(&[DVec3::X * 2.0; 100], &[DVec3::X; 100], &path);
        assert!((net - 0.1).abs() < 1e-12 && (up - 0.1).abs() < 1e-12);
    }

    #[test]
    fn steps_count_only_where_a_model_is_new() {
        let sent: Vec<_> =
            (0..100).map(|n| DVec3::Y * f64::from(n / 10) + DVec3::X * f64::from(n % 2)).collect();
        let fresh: Vec<_> = (0..100).map(|n| n % 10 == 0).collect();
        assert!((swap_step(&sent, &fresh, 0.95) - 2.0_f64.sqrt()).abs() < 1e-12);
    }
}
