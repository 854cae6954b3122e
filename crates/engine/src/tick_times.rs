//! How long the servo's ticks take, and how late they begin.

/// Entries of the histogram: 0.1 µs each, then all that is longer.
const BINS: usize = 2000;

/// Times of the servo's ticks, as a histogram.
#[derive(Clone, Debug)]
pub struct TickTimes {
    bins: Vec<u32>,
    /// The longest tick, ns.
    pub longest_ns: u64,
    /// Ticks that began more than half a period late.
    pub late: u64,
}

impl Default for TickTimes {
    fn default() -> Self {
        Self { bins: vec![0; BINS], longest_ns: 0, late: 0 }
    }
}

impl TickTimes {
    /// Adds a tick of `ns` nanoseconds.
    pub fn add(&mut self, ns: u64) {
        self.bins[(ns as usize / 100).min(BINS - 1)] += 1;
        self.longest_ns = self.longest_ns.max(ns);
    }

    /// How many ticks there were.
    pub fn count(&self) -> u64 {
        self.bins.iter().map(|n| u64::from(*n)).sum()
    }

    /// The time (s) that the share `quantile` (0..1) of all ticks stayed below, to 0.1 µs, and not above 200 µs.
    pub fn quantile_s(&self, quantile: f64) -> f64 {
        let total = self.count();
        let mut below = 0;
        for (k, n) in self.bins.iter().enumerate() {
            below += u64::from(*n);
            if below as f64 >= quantile * total as f64 && total > 0 {
                return (k + 1) as f64 * 1e-7;
            }
        }
        0.0
    }

    /// Becomes as `other`, in its own memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.bins.copy_from_slice(&other.bins);
        (self.longest_ns, self.late) = (other.longest_ns, other.late);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_count_and_longest() {
        let mut times = TickTimes::default();
        assert_eq!((times.count(), times.quantile_s(0.5)), (0, 0.0));
        (0..99).for_each(|_| times.add(950));
        times.add(3_000_000);
        assert_eq!((times.count(), times.longest_ns), (100, 3_000_000));
        assert!((times.quantile_s(0.5) - 1e-6).abs() < 1e-12);
        assert!((times.quantile_s(1.0) - 200e-6).abs() < 1e-12);
        let mut copy = TickTimes::default();
        copy.copy_from(&times);
        assert_eq!((copy.bins, copy.longest_ns), (times.bins, 3_000_000));
    }
}
