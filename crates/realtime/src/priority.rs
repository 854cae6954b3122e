//! The priority of the calling thread.
//!
//! Source: Linux manual, `sched(7)`: `SCHED_FIFO` threads run before all ordinary ones, and until they sleep.

use crate::{os, status::Refusal};

/// Gives the calling thread real-time priority `priority` (1 to 99, more goes first; `SCHED_FIFO` on Linux).
///
/// Threads that it spawns do not inherit it (`SCHED_RESET_ON_FORK`). Stay below 99, where the kernel's own watchdogs
/// are; 50 is the usual priority of interrupt threads on a real-time kernel, 60 to 80 usual for audio and haptics.
///
/// Thread: any, before its time loop (system call).
///
/// # Errors
/// A [`Refusal`] that says what to do; the priority is then as before.
pub fn set_realtime_priority(priority: u8) -> Result<(), Refusal> {
    match priority {
        1..=99 => os::set_realtime_priority(priority),
        _ => Err(Refusal::OutOfRange { priority }),
    }
}

/// Gives the calling thread ordinary priority, whatever it inherited.
///
/// For the workers of a pool that may have been spawned by a real-time thread of a host: call it as each starts.
///
/// Thread: any (system call).
///
/// # Errors
/// [`Refusal::NotSupported`] where this crate sets no priorities, [`Refusal::System`] otherwise.
pub fn set_normal_priority() -> Result<(), Refusal> {
    os::set_normal_priority()
}

/// Whether the calling thread has real-time priority, for example one that a host owns; false where unknown.
///
/// Thread: any (system call).
#[must_use]
pub fn is_realtime() -> bool {
    os::is_realtime()
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    #[test]
    fn priorities_out_of_range_are_refused() {
        for priority in [0, 100, 255] {
            assert_eq!(set_realtime_priority(priority), Err(Refusal::OutOfRange { priority }));
        }
    }
}
