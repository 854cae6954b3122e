//! Systems without code of their own: time from the standard library, no priorities, no memory locks.

use std::{
    sync::OnceLock,
    thread,
    time::{Duration, Instant},
};

use crate::status::Refusal;

static START: OnceLock<Instant> = OnceLock::new();

/// Time since the first call, ns.
pub(crate) fn monotonic_ns() -> u64 {
    u64::try_from(START.get_or_init(Instant::now).elapsed().as_nanos()).unwrap_or(u64::MAX)
}

/// Not known here: the time on the clock.
pub(crate) fn thread_cpu_ns() -> u64 {
    monotonic_ns()
}

/// Not known here.
pub(crate) fn process_cpu_s() -> f64 {
    0.0
}

/// Sleeps until [`monotonic_ns`] is about `t`.
pub(crate) fn sleep_until_ns(t: u64) {
    thread::sleep(Duration::from_nanos(t.saturating_sub(monotonic_ns())));
}

pub(crate) fn set_realtime_priority(_priority: u8) -> Result<(), Refusal> {
    Err(Refusal::NotSupported)
}

pub(crate) fn set_normal_priority() -> Result<(), Refusal> {
    Err(Refusal::NotSupported)
}

pub(crate) fn is_realtime() -> bool {
    false
}

pub(crate) fn lock_memory() -> Result<(), Refusal> {
    Err(Refusal::NotSupported)
}

pub(crate) fn unlock_memory() -> Result<(), Refusal> {
    Err(Refusal::NotSupported)
}
