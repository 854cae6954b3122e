//! How late a 1 kHz loop is on this machine.

use hapflow_realtime::Clock;

/// Time between two ticks: 1 kHz, as the servo.
const TICK_NS: u64 = 1_000_000;

/// How late the ticks of a loop were, µs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lateness {
    /// Half of the ticks were no later than this.
    pub median_us: f64,
    /// 99 % of the ticks were no later than this.
    pub p99_us: f64,
    /// The latest.
    pub worst_us: f64,
}

/// Waits for `ticks` deadlines, 1 ms apart, and says how late each was met.
///
/// The deadlines stand fast: while a stall lasts, each tick that should have come counts as late. So a share of
/// the ticks is a share of the time.
pub fn run(clock: &dyn Clock, ticks: u32) -> Lateness {
    let start = clock.now_ns();
    let mut late_ns = Vec::with_capacity(ticks as usize);
    for tick in 1..=u64::from(ticks) {
        let due = start + tick * TICK_NS;
        clock.wait_until_ns(due);
        late_ns.push(clock.now_ns().saturating_sub(due));
    }
    summarize(late_ns)
}

/// Takes the numbers of `late_ns`; zeros if there are none.
fn summarize(mut late_ns: Vec<u64>) -> Lateness {
    late_ns.sort_unstable();
    let us = |quantile: f64| {
        let rank = (quantile * late_ns.len() as f64).ceil() as usize;
        late_ns.get(rank.saturating_sub(1)).map_or(0.0, |&ns| ns as f64 / 1e3)
    };
    Lateness { median_us: us(0.5), p99_us: us(0.99), worst_us: us(1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hapflow_realtime::VirtualClock;
    use std::sync::atomic::{AtomicU64, Ordering};

    #[test]
    fn quantiles_are_nearest_ranks() {
        let late = summarize((1..=500).rev().map(|k| k * 1000).collect());
        assert_eq!(late, Lateness { median_us: 250.0, p99_us: 495.0, worst_us: 500.0 });
        assert_eq!(summarize(vec![2500]), Lateness { median_us: 2.5, p99_us: 2.5, worst_us: 2.5 });
        assert_eq!(summarize(Vec::new()), Lateness::default());
    }

    #[test]
    fn a_perfect_clock_is_never_late() {
        let clock = VirtualClock::new();
        assert_eq!(run(&clock, 500), Lateness::default());
        assert_eq!(clock.now_ns(), 500 * TICK_NS);
    }

    /// Sleeps through all deadlines before 10 ms.
    struct Stalls(AtomicU64);

    impl Clock for Stalls {
        fn now_ns(&self) -> u64 {
            self.0.load(Ordering::Relaxed)
        }

        fn wait_until_ns(&self, t: u64) {
            self.0.fetch_max(t.max(10 * TICK_NS), Ordering::Relaxed);
        }
    }

    #[test]
    fn a_stall_makes_each_tick_in_it_late() {
        let late = run(&Stalls(AtomicU64::new(0)), 20);
        assert_eq!(late, Lateness { median_us: 0.0, p99_us: 9000.0, worst_us: 9000.0 });
    }
}
