//! A clock that costs no time: waiting moves it.

use super::Clock;
use crate::sync::{AtomicU64, Ordering};

/// Time as a counter, from 0 at construction: [`wait_until_ns`](Clock::wait_until_ns) jumps there at once.
///
/// For tests, replays and drives by a host, where the result must not depend on the machine's speed. Who sees a
/// time also sees what the thread that set it wrote before.
///
/// Thread: any. Cost: one atomic operation a call; wait-free.
#[derive(Debug)]
pub struct VirtualClock(AtomicU64);

impl VirtualClock {
    /// A clock at 0 ns.
    #[must_use]
    pub fn new() -> Self {
        Self(AtomicU64::new(0))
    }

    /// Moves the clock on by `by` ns.
    pub fn advance_ns(&self, by: u64) {
        self.0.fetch_add(by, Ordering::AcqRel);
    }
}

impl Default for VirtualClock {
    fn default() -> Self {
        Self::new()
    }
}

impl Clock for VirtualClock {
    fn now_ns(&self) -> u64 {
        self.0.load(Ordering::Acquire)
    }

    /// Moves the clock to `t` where it is behind, and never backwards.
    fn wait_until_ns(&self, t: u64) {
        self.0.fetch_max(t, Ordering::AcqRel);
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    #[test]
    fn waiting_jumps_forwards_only() {
        let clock = VirtualClock::new();
        clock.wait_until_ns(5_000);
        clock.wait_until_ns(3_000);
        assert_eq!(clock.now_ns(), 5_000);
        clock.advance_ns(10);
        assert_eq!(clock.now_ns(), 5_010);
    }
}
