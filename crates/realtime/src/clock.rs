//! Time as the loops see it: nanoseconds since a clock's start, real or virtual.

mod host;
mod real;
mod simulated;

pub use host::HostClock;
pub use real::{DEFAULT_SPIN_MARGIN, RealClock};
pub use simulated::VirtualClock;

/// A clock that never goes backwards, in nanoseconds since its own start.
///
/// Share one as `Arc<dyn Clock>`: times of two clocks are not comparable. To keep a rate, add the period to the
/// last deadline, not to the time of waking, or the lateness of each tick adds up.
///
/// Thread: any.
pub trait Clock: Send + Sync {
    /// The time now, in ns. 64 bits last for 584 years.
    ///
    /// Cost: no system call where the system can do without (tens of ns on Linux).
    fn now_ns(&self) -> u64;

    /// Returns once [`now_ns`](Self::now_ns) is at least `t`; at once if it already is.
    fn wait_until_ns(&self, t: u64);
}

/// CPU time that the calling thread has used, ns; where the system does not tell, the time on its clock. Thread: any. A look
/// costs a system call.
#[must_use]
pub fn thread_cpu_ns() -> u64 {
    crate::os::thread_cpu_ns()
}

/// CPU time that all threads of the process have used, s; 0 where the system does not tell. Thread: any.
#[must_use]
pub fn process_cpu_s() -> f64 {
    crate::os::process_cpu_s()
}
