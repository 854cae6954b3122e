//! Estimators: from a series of samples to a number.

/// A series of samples: time (s) and value.
pub type Series = [[f64; 2]];

/// The samples of the last `share` of the series.
pub fn last(series: &Series, share: f64) -> &Series {
    &series[series.len() - (series.len() as f64 * share).ceil() as usize..]
}

/// Mean value.
pub fn mean(series: &Series) -> f64 {
    series.iter().map(|s| s[1]).sum::<f64>() / series.len() as f64
}

/// Standard deviation.
pub fn deviation(series: &Series) -> f64 {
    let mean = mean(series);
    (series.iter().map(|s| (s[1] - mean).powi(2)).sum::<f64>() / series.len() as f64).sqrt()
}

/// Means of `count` samples each; a rest that is too short is left out.
pub fn blocks(series: &Series, count: usize) -> Vec<[f64; 2]> {
    let block = |b: &Series| [b.iter().map(|s| s[0]).sum::<f64>() / b.len() as f64, mean(b)];
    series.chunks_exact(count.max(1)).map(block).collect()
}

/// Coefficients c for which Σ c_k f_k(t) is nearest to the series (least squares); NaN if they are not determined.
pub fn fit<const N: usize>(series: &Series, functions: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let mut matrix = [[0.0; N]; N];
    let mut right = [0.0; N];
    for &[t, value] in series {
        let f = functions(t);
        for i in 0..N {
            right[i] += f[i] * value;
            for j in 0..N {
                matrix[i][j] += f[i] * f[j];
            }
        }
    }
    solve(matrix, right)
}

/// Solution of a symmetric positive definite system, by elimination.
fn solve<const N: usize>(mut matrix: [[f64; N]; N], mut right: [f64; N]) -> [f64; N] {
    for k in 0..N {
        for i in k + 1..N {
            let share = matrix[i][k] / matrix[k][k];
            let pivot = matrix[k];
            for (to, from) in matrix[i].iter_mut().zip(pivot) {
                *to -= share * from;
            }
            right[i] -= share * right[k];
        }
    }
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|j| matrix[k][j] * right[j]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right
}

/// The straight line through the series: its value at t = 0, and its slope.
pub fn line(series: &Series) -> [f64; 2] {
    fit(series, |t| [1.0, t])
}

/// The sine of angular frequency `omega` (rad/s) in the series, beside a straight line: the factors of cos ωt and sin ωt.
pub fn sine(series: &Series, omega: f64) -> [f64; 2] {
    // Time from the middle: else line and sine are told apart badly.
    let middle = series.iter().map(|s| s[0]).sum::<f64>() / series.len() as f64;
    let [_, _, c, s] = fit(series, |t| {
        let phase = omega * t;
        [1.0, t - middle, phase.cos(), phase.sin()]
    });
    [c, s]
}

/// Angular frequency (rad/s) of an oscillation round 0, from its first zero to its last.
pub fn angular_frequency(series: &Series) -> f64 {
    let crosses = |w: &[[f64; 2]]| (w[0][1] < 0.0) != (w[1][1] < 0.0);
    let at = |w: &[[f64; 2]]| w[0][0] + (w[1][0] - w[0][0]) * w[0][1] / (w[0][1] - w[1][1]);
    let zeros: Vec<_> =
        series.windows(2).filter(|w| crosses(w)).enumerate().map(|(k, w)| [k as f64, at(w)]).collect();
    std::f64::consts::PI / line(&zeros)[1]
}

/// Rate (1/s) at which a positive series decays: minus the slope of its logarithm.
pub fn decay_rate(series: &Series) -> f64 {
    let logarithms: Vec<_> = series.iter().map(|s| [s[0], s[1].ln()]).collect();
    -line(&logarithms)[1]
}

/// Time after which the oscillation of period `period` (s) stays below `amplitude`, as the deviation over a period
/// round that time tells; near the series' end if it never does.
pub fn settling_time(series: &Series, period: f64, amplitude: f64) -> f64 {
    let step = (series[series.len() - 1][0] - series[0][0]) / (series.len() - 1) as f64;
    let count = (period / step).round().max(2.0) as usize;
    let loud = |w: &&Series| 2.0_f64.sqrt() * deviation(w) > amplitude;
    series.windows(count).rfind(loud).map_or(0.0, |w| w[count / 2][0])
}

/// Order of convergence: slope of log error over log spacing. None for fewer than two positive errors.
pub fn order(errors: &[[f64; 2]]) -> Option<f64> {
    let usable = |e: &&[f64; 2]| e[1].is_finite() && e[1] > 0.0;
    let logarithms: Vec<_> = errors.iter().filter(usable).map(|e| [e[0].ln(), e[1].ln()]).collect();
    Some(line(&logarithms)[1]).filter(|slope| logarithms.len() > 1 && slope.is_finite())
}

/// Limit of values (spacing, value) at spacing 0: that of L + s dx^p which is nearest to them, with an order p from 1 to
/// 2, the order of the scheme at its best (Richardson's extrapolation). None for fewer than two values.
pub fn limit(values: &Series) -> Option<f64> {
    let at_order = |p: f64| {
        let scaled: Vec<_> = values.iter().map(|v| [v[0].powf(p), v[1]]).collect();
        let [limit, slope] = line(&scaled);
        let miss: f64 = scaled.iter().map(|v| (limit + slope * v[0] - v[1]).powi(2)).sum();
        (miss, limit)
    };
    let orders = (0..=10).map(|k| at_order(1.0 + 0.1 * f64::from(k)));
    let best = orders.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, limit)| limit);
    best.filter(|limit| values.len() > 1 && limit.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(f: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        (0..1000).map(|k| 0.01 * f64::from(k)).map(|t| [t, f(t)]).collect()
    }

    #[test]
    fn a_line_and_a_sine_are_told_apart() {
        let [c, s] = sine(&series(|t| 3.0 + 0.2 * t + 0.5 * (7.0 * t).cos() - 0.25 * (7.0 * t).sin()), 7.0);
        assert!((c - 0.5).abs() < 1e-9 && (s + 0.25).abs() < 1e-9, "{c} {s}");
        let [c, s] = sine(&series(|t| 3.0 + 0.2 * t + (9.0 * t).cos()), 7.0);
        assert!(c.hypot(s) < 0.1, "another frequency leaks: {c} {s}");
    }

    #[test]
    fn frequency_and_decay_of_a_damped_oscillation() {
        let damped = series(|t| (-0.3 * t).exp() * (5.0 * t + 0.4).sin());
        assert!((angular_frequency(&damped) / 5.0 - 1.0).abs() < 1e-3);
        assert!((decay_rate(&series(|t| 2.0 * (-0.3 * t).exp())) - 0.3).abs() < 1e-9);
    }

    #[test]
    fn a_bounce_settles_when_its_amplitude_has_passed() {
        let ringing = series(|t| 1.0 + (-t).exp() * (20.0 * t).sin());
        let period = std::f64::consts::TAU / 20.0;
        let settled = settling_time(&ringing, period, 0.05);
        assert!((settled - 20.0_f64.ln()).abs() < 0.5 * period, "{settled}");
        assert_eq!(settling_time(&series(|_| 1.0), period, 0.05), 0.0);
        assert!(settling_time(&series(|t| (20.0 * t).sin()), period, 0.05) > 9.8);
    }

    #[test]
    fn the_order_is_the_slope() {
        let errors: Vec<_> = [0.1, 0.05, 0.02].iter().map(|&h: &f64| [h, 3.0 * h.powf(1.5)]).collect();
        assert!((order(&errors).unwrap() - 1.5).abs() < 1e-9);
        assert_eq!(order(&errors[..1]), None);
        assert_eq!(order(&[[0.1, 0.0], [0.05, 1.0]]), None);
    }

    #[test]
    fn a_limit_is_found_at_either_order() {
        for p in [1.0, 1.5, 2.0] {
            let values: Vec<_> = [0.5, 0.4, 0.2].iter().map(|&h: &f64| [h, 7.0 - 3.0 * h.powf(p)]).collect();
            assert!((limit(&values).unwrap() - 7.0).abs() < 1e-6, "{p}");
        }
        assert_eq!(limit(&[[0.5, 1.0]]), None);
    }

    #[test]
    fn blocks_and_tails() {
        let numbers: Vec<_> = (0..10).map(|k| [f64::from(k), f64::from(k)]).collect();
        assert_eq!(blocks(&numbers, 4), vec![[1.5, 1.5], [5.5, 5.5]]);
        assert_eq!(last(&numbers, 0.25), &numbers[7..]);
        assert!((deviation(&[[0.0, 1.0], [1.0, 3.0]]) - 1.0).abs() < 1e-12);
    }
}
