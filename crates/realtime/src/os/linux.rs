//! Linux: `clock_nanosleep(2)`, `sched_setscheduler(2)`, `mlockall(2)`, `getrlimit(2)`.

use std::{io, mem, ptr};

use crate::status::Refusal;

const NS_PER_S: u64 = 1_000_000_000;

/// `CLOCK_MONOTONIC`, ns.
pub(crate) fn monotonic_ns() -> u64 {
    let mut now = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: `now` is a timespec to write to. The call cannot fail: this clock is always there.
    unsafe { libc::clock_gettime(libc::CLOCK_MONOTONIC, &mut now) };
    now.tv_sec as u64 * NS_PER_S + now.tv_nsec as u64
}

/// CPU time of the calling thread, ns.
pub(crate) fn thread_cpu_ns() -> u64 {
    let mut used = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: `used` is a timespec to write to. The call cannot fail: this clock is always there.
    unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut used) };
    used.tv_sec as u64 * NS_PER_S + used.tv_nsec as u64
}

/// CPU time of all threads of the process, s.
pub(crate) fn process_cpu_s() -> f64 {
    let mut used = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: `used` is a timespec to write to. The call cannot fail: this clock is always there.
    unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut used) };
    used.tv_sec as f64 + used.tv_nsec as f64 / NS_PER_S as f64
}

/// Sleeps until [`monotonic_ns`] is `t`, through any signals.
pub(crate) fn sleep_until_ns(t: u64) {
    let until =
        libc::timespec { tv_sec: (t / NS_PER_S) as libc::time_t, tv_nsec: (t % NS_PER_S) as libc::c_long };
    let sleep = || {
        // SAFETY: `until` is a timespec to read; a null pointer asks for no remaining time.
        unsafe { libc::clock_nanosleep(libc::CLOCK_MONOTONIC, libc::TIMER_ABSTIME, &until, ptr::null_mut()) }
    };
    while sleep() == libc::EINTR {}
}

/// Asks for `SCHED_FIFO`; children are ordinary.
pub(crate) fn set_realtime_priority(priority: u8) -> Result<(), Refusal> {
    set_policy(libc::SCHED_FIFO, i32::from(priority)).map_err(|refusal| match refusal {
        Refusal::System { code: libc::EPERM } => Refusal::Priority { priority, limit: priority_limit() },
        other => other,
    })
}

/// Asks for `SCHED_OTHER`.
pub(crate) fn set_normal_priority() -> Result<(), Refusal> {
    set_policy(libc::SCHED_OTHER, 0)
}

/// Whether the policy is `SCHED_FIFO` or `SCHED_RR`.
pub(crate) fn is_realtime() -> bool {
    // SAFETY: the call has no pointers; 0 stands for the calling thread.
    let policy = unsafe { libc::syscall(libc::SYS_sched_getscheduler, 0) };
    let policy = policy & !libc::c_long::from(libc::SCHED_RESET_ON_FORK);
    [libc::SCHED_FIFO, libc::SCHED_RR].map(libc::c_long::from).contains(&policy)
}

/// Locks all pages, unless a limit stands in the way.
pub(crate) fn lock_memory() -> Result<(), Refusal> {
    lift_memory_limit()?;
    // SAFETY: the call has no pointers.
    done(unsafe { libc::mlockall(libc::MCL_CURRENT | libc::MCL_FUTURE) })
}

/// Unlocks all pages.
pub(crate) fn unlock_memory() -> Result<(), Refusal> {
    // SAFETY: the call has no pointers.
    done(unsafe { libc::munlockall() })
}

/// Sets the policy of the calling thread, by system call, since musl's wrapper only fails. The flag stays set for
/// ordinary threads too: the kernel lets no ordinary user take it back.
fn set_policy(policy: i32, priority: i32) -> Result<(), Refusal> {
    // SAFETY: all-zero bytes are a valid `sched_param`, a C struct of integers.
    let mut param: libc::sched_param = unsafe { mem::zeroed() };
    param.sched_priority = priority;
    let policy = policy | libc::SCHED_RESET_ON_FORK;
    // SAFETY: `param` is a sched_param to read; 0 stands for the calling thread.
    let result = unsafe { libc::syscall(libc::SYS_sched_setscheduler, 0, policy, &raw const param) };
    done(result as i32)
}

/// Sees to it that no limit on locked memory holds, or says what it is.
fn lift_memory_limit() -> Result<(), Refusal> {
    let limit = memory_limit();
    if limit.rlim_cur == libc::RLIM_INFINITY {
        return Ok(());
    }
    let none = libc::rlimit { rlim_cur: libc::RLIM_INFINITY, rlim_max: libc::RLIM_INFINITY };
    // SAFETY: `none` is an rlimit to read.
    done(unsafe { libc::setrlimit(libc::RLIMIT_MEMLOCK, &none) })
        .map_err(|_| Refusal::MemoryLimit { limit_kib: limit.rlim_max / 1024 })
}

/// The highest real-time priority that an ordinary user may have; 0 where it cannot be read.
fn priority_limit() -> u64 {
    let mut limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
    // SAFETY: `limit` is an rlimit to write to.
    unsafe { libc::getrlimit(libc::RLIMIT_RTPRIO, &mut limit) };
    limit.rlim_cur
}

/// How much memory the process may lock, now and at most; 0 where it cannot be read.
fn memory_limit() -> libc::rlimit {
    let mut limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
    // SAFETY: `limit` is an rlimit to write to.
    unsafe { libc::getrlimit(libc::RLIMIT_MEMLOCK, &mut limit) };
    limit
}

/// The result of a system call that answers 0, or -1 and an error number.
fn done(result: i32) -> Result<(), Refusal> {
    match result {
        0 => Ok(()),
        _ => Err(Refusal::System { code: io::Error::last_os_error().raw_os_error().unwrap_or(0) }),
    }
}
