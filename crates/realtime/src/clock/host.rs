//! Time as a host program tells it, tick by tick.

use super::Clock;
use std::{
    sync::atomic::{AtomicBool, AtomicU64, Ordering},
    thread,
    time::Duration,
};

/// How often a waiter looks. A fluid frame takes some ten of these.
const LOOK: Duration = Duration::from_micros(200);

/// A clock that stands still until the host's servo moves it on: the fluid's own thread then keeps the host's
/// time, whatever that is. Thread: [`set_ns`](Self::set_ns) servo (wait-free); waiting is for threads that may.
#[derive(Debug)]
pub struct HostClock {
    now: AtomicU64,
    closed: AtomicBool,
}

impl Default for HostClock {
    fn default() -> Self {
        Self::new()
    }
}

impl HostClock {
    /// At time 0.
    #[must_use]
    pub fn new() -> Self {
        Self { now: AtomicU64::new(0), closed: AtomicBool::new(false) }
    }

    /// It is now `t`; an earlier time than before is passed over. Thread: servo, any number of them.
    pub fn set_ns(&self, t: u64) {
        self.now.fetch_max(t, Ordering::AcqRel);
    }

    /// Nobody will move it on: every wait ends at once, now and later. Thread: any.
    pub fn close(&self) {
        self.closed.store(true, Ordering::Release);
    }
}

impl Clock for HostClock {
    fn now_ns(&self) -> u64 {
        self.now.load(Ordering::Acquire)
    }

    fn wait_until_ns(&self, t: u64) {
        while self.now_ns() < t && !self.closed.load(Ordering::Acquire) {
            thread::sleep(LOOK);
        }
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn a_waiter_goes_on_when_the_host_gets_there_or_the_clock_is_closed() {
        let clock = Arc::new(HostClock::new());
        clock.set_ns(5);
        clock.set_ns(3);
        assert_eq!(clock.now_ns(), 5);
        clock.wait_until_ns(5);
        for close in [false, true] {
            let theirs = Arc::clone(&clock);
            let waiter = thread::spawn(move || theirs.wait_until_ns(1000));
            if close {
                clock.close()
            } else {
                clock.set_ns(1000)
            }
            assert!(waiter.join().is_ok());
        }
    }
}
