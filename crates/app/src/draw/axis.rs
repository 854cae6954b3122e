//! A scale along one side of a chart.

/// Below this many decades a logarithmic scale is nearly even, and so are its ticks.
const WITHIN: f64 = 0.3;

/// Range of values along a side, and where its ticks are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    pub low: f64,
    pub high: f64,
    /// Distance between ticks.
    pub step: f64,
    /// Whether values are logarithms to the base 10; ticks are then at round numbers.
    pub log: bool,
}

impl Axis {
    /// A scale that holds `values`, with `room` of their range free at either end, and about `count` ticks.
    pub fn holding(values: impl Iterator<Item = f64>, room: f64, count: f64) -> Self {
        let grow = |(low, high): (f64, f64), v: f64| (low.min(v), high.max(v));
        let (mut low, mut high) = values.filter(|v| v.is_finite()).fold((f64::MAX, f64::MIN), grow);
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        let least = (1e-6 * low.abs().max(high.abs())).max(1e-9);
        if high - low < least {
            let half = (0.1 * low.abs()).max(0.5);
            (low, high) = (low - half, high + half);
        }
        let pad = room * (high - low);
        (low, high) = (low - pad, high + pad);
        Self { low, high, step: step((high - low) / count.max(1.0)), log: false }
    }

    /// The same scale, of logarithms or not.
    pub fn logarithmic(self, log: bool) -> Self {
        Self { log, ..self }
    }

    /// Where `value` lies, 0 at the low end and 1 at the high end.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// Values of the ticks.
    pub fn ticks(&self) -> Vec<f64> {
        if self.log {
            return self.round_numbers();
        }
        let first = (self.low / self.step - 1e-9).ceil();
        let count = ((self.high / self.step + 1e-9).floor() - first).clamp(-1.0, 200.0) as i64;
        (0..=count).map(|i| (first + i as f64) * self.step).collect()
    }

    /// Logarithms of 1 to 9 in each decade, of fewer of them where decades are narrow, and of any round numbers within one.
    fn round_numbers(&self) -> Vec<f64> {
        if self.high - self.low < WITHIN {
            let [low, high] = [self.low, self.high].map(|v| 10.0_f64.powf(v));
            let even = Self { low, high, step: step((high - low) / 6.0), log: false };
            return even.ticks().into_iter().map(f64::log10).collect();
        }
        let factors: &[f64] = match self.high - self.low {
            wide if wide > 4.0 => &[1.0],
            wide if wide > 0.7 => &[1.0, 2.0, 5.0],
            _ => &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
        };
        let decades = self.low.floor() as i64..=self.high.ceil() as i64;
        let all = decades.take(100).flat_map(|d| factors.iter().map(move |f| f.log10() + d as f64));
        all.filter(|v| (self.low..=self.high).contains(v)).collect()
    }

    /// How the tick at `value` is written.
    pub fn text(&self, value: f64) -> String {
        if self.log {
            let places = (2.0 - (value + 1e-9).floor()).clamp(0.0, 9.0) as usize;
            let text = format!("{:.places$}", 10.0_f64.powf(value));
            return if places > 0 { text.trim_end_matches('0').trim_end_matches('.').into() } else { text };
        }
        let places = (-self.step.log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize;
        let text = format!("{:.*}", places, if value.abs() < 1e-6 * self.step { 0.0 } else { value });
        text.replace('-', "\u{2212}")
    }
}

/// The round number 1, 2 or 5 times a power of ten next above `least`.
fn step(least: f64) -> f64 {
    let decade = 10.0_f64.powf(least.log10().floor());
    let share = least / decade;
    decade
        * if share > 5.0 {
            10.0
        } else if share > 2.0 {
            5.0
        } else if share > 1.0 {
            2.0
        } else {
            1.0
        }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::holding([-0.31, 1.27].into_iter(), 0.05, 6.0);
        let texts: Vec<String> = axis.ticks().into_iter().map(|v| axis.text(v)).collect();
        assert_eq!(texts, ["0.0", "0.5", "1.0"]);
    }

    #[test]
    fn a_logarithmic_scale_has_round_numbers() {
        let texts = |low: f64, high: f64| -> Vec<String> {
            let axis = Axis::holding([low.log10(), high.log10()].into_iter(), 0.0, 6.0).logarithmic(true);
            axis.ticks().into_iter().map(|v| axis.text(v)).collect()
        };
        assert_eq!(texts(0.009, 0.02), ["0.009", "0.01", "0.02"]);
        assert_eq!(texts(0.009, 0.04), ["0.009", "0.01", "0.02", "0.03", "0.04"]);
        assert_eq!(texts(14.2, 18.3), ["15", "16", "17", "18"]);
        assert_eq!(texts(0.0015, 0.11), ["0.002", "0.005", "0.01", "0.02", "0.05", "0.1"]);
        assert_eq!(texts(1e-5, 30.0), ["0.00001", "0.0001", "0.001", "0.01", "0.1", "1", "10"]);
    }

    #[test]
    fn nothing_and_a_constant_have_a_range() {
        for values in [vec![], vec![f64::NAN], vec![3.0, 3.0], vec![0.0]] {
            let axis = Axis::holding(values.into_iter(), 0.05, 6.0);
            assert!(axis.high > axis.low && axis.step > 0.0 && axis.ticks().len() > 1);
        }
    }
}
