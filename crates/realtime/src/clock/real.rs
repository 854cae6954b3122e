//! The clock of the real world: the system's monotonic clock, waited for by sleeping and then spinning.
//!
//! A sleep alone wakes late, by about 0.1 ms at the median and several ms at worst on a busy machine; the spin at
//! the end takes up the usual part of that, at the cost of the processor time it burns. The sleep is until a point
//! in time, not for a while, so that being preempted on the way into it adds nothing.
//!
//! Source: Linux manual, `clock_nanosleep(2)`.

use std::{hint, time::Duration};

use super::Clock;
use crate::os;

/// 200 µs: more than a real-time thread usually wakes late on a desktop kernel, a fifth of a 1 kHz tick.
pub const DEFAULT_SPIN_MARGIN: Duration = Duration::from_micros(200);

/// The system's monotonic clock, from 0 at construction.
#[derive(Clone, Debug)]
pub struct RealClock {
    /// System time at construction, ns.
    origin: u64,
    /// How long before the deadline sleeping ends and spinning begins, ns.
    spin: u64,
}

impl RealClock {
    /// Starts a clock with [`DEFAULT_SPIN_MARGIN`]. Thread: any.
    #[must_use]
    pub fn new() -> Self {
        Self::with_spin_margin(DEFAULT_SPIN_MARGIN)
    }

    /// Starts a clock that sleeps until `margin` before each deadline and then spins. Thread: any.
    ///
    /// Zero: never spin, for threads that may be late (an ordinary fluid thread, battery). As long as the period:
    /// never sleep, for a processor of its own.
    #[must_use]
    pub fn with_spin_margin(margin: Duration) -> Self {
        Self { origin: os::monotonic_ns(), spin: u64::try_from(margin.as_nanos()).unwrap_or(u64::MAX) }
    }
}

impl Default for RealClock {
    fn default() -> Self {
        Self::new()
    }
}

impl Clock for RealClock {
    fn now_ns(&self) -> u64 {
        os::monotonic_ns().saturating_sub(self.origin)
    }

    fn wait_until_ns(&self, t: u64) {
        let wake = t.saturating_sub(self.spin);
        if self.now_ns() < wake {
            os::sleep_until_ns(self.origin.saturating_add(wake));
        }
        while self.now_ns() < t {
            hint::spin_loop();
        }
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    /// Never early, whatever the margin. How late is the machine's matter, so no test asks.
    #[test]
    fn a_wait_is_never_short() {
        for margin in [Duration::ZERO, DEFAULT_SPIN_MARGIN, Duration::MAX] {
            let clock = RealClock::with_spin_margin(margin);
            let deadline = clock.now_ns() + 2_000_000;
            clock.wait_until_ns(deadline);
            assert!(clock.now_ns() >= deadline);
        }
    }

    #[test]
    fn a_past_deadline_returns_and_time_only_grows() {
        let clock = RealClock::new();
        clock.wait_until_ns(0);
        let first = clock.now_ns();
        assert!(clock.now_ns() >= first);
    }
}
