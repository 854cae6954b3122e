//! Threads that keep time.

use std::{
    fmt, io,
    sync::mpsc,
    thread::{self, JoinHandle},
};

use crate::{priority::set_realtime_priority, status::RealtimeStatus};

/// A running thread and what the system granted it; made by [`spawn_realtime`].
///
/// Dropping it lets the thread run on by itself.
pub struct RealtimeThread<R> {
    handle: JoinHandle<R>,
    status: RealtimeStatus,
}

impl<R> RealtimeThread<R> {
    /// What the thread was granted when it started.
    #[must_use]
    pub fn status(&self) -> &RealtimeStatus {
        &self.status
    }

    /// Whether `f` has returned or panicked. Thread: any.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.handle.is_finished()
    }

    /// Waits for the thread to end and gives what `f` returned. Thread: main (blocks).
    ///
    /// # Errors
    /// What `f` panicked with.
    pub fn join(self) -> thread::Result<R> {
        self.handle.join()
    }
}

impl<R> fmt::Debug for RealtimeThread<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RealtimeThread").field("status", &self.status).finish_non_exhaustive()
    }
}

/// Runs `f` on a new thread called `name`, with real-time priority `priority` if the system grants it.
///
/// If it does not, `f` runs at ordinary priority, and the [status](RealtimeThread::status) says why. For
/// `priority` see [`set_realtime_priority`]. Memory is not locked here: see [`lock_memory`](crate::lock_memory).
/// The name must not contain a zero byte; Linux shows its first 15 bytes.
///
/// Thread: main (blocks until the thread has started, before `f`).
///
/// # Errors
/// The system could not start a thread at all, or the name contains a zero byte.
pub fn spawn_realtime<R, F>(name: &str, priority: u8, f: F) -> io::Result<RealtimeThread<R>>
where
    R: Send + 'static,
    F: FnOnce() -> R + Send + 'static,
{
    if name.contains('\0') {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "a thread's name must not contain a zero byte",
        ));
    }
    let (tell, told) = mpsc::sync_channel(1);
    let handle = thread::Builder::new().name(name.to_owned()).spawn(move || {
        // Fails only if the spawning thread has gone, which then does not care.
        let _ = tell.send(set_realtime_priority(priority).into());
        drop(tell);
        f()
    })?;
    let priority = told.recv().unwrap_or_default();
    Ok(RealtimeThread { handle, status: RealtimeStatus { priority, ..RealtimeStatus::default() } })
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;
    use crate::{Grant, Refusal, is_realtime, set_normal_priority};

    /// Holds on machines that grant the priority and on those that refuse it.
    #[test]
    fn the_status_is_the_truth_and_the_thread_runs_anyway() {
        let thread = spawn_realtime("servo", 10, is_realtime).unwrap();
        let granted = thread.status().priority.is_granted();
        assert_ne!(thread.status().priority, Grant::NotAsked);
        assert_eq!(thread.status().memory, Grant::NotAsked);
        assert_eq!(thread.join().unwrap(), granted);
    }

    #[test]
    fn a_refused_priority_is_reported() {
        let thread = spawn_realtime("servo", 0, || 7).unwrap();
        assert_eq!(thread.status().priority, Grant::Refused(Refusal::OutOfRange { priority: 0 }));
        assert_eq!(thread.join().unwrap(), 7);
    }

    #[test]
    fn children_do_not_inherit_and_priority_can_be_given_back() {
        let child = || thread::spawn(is_realtime).join().unwrap();
        let thread =
            spawn_realtime("servo", 10, move || (child(), set_normal_priority(), is_realtime())).unwrap();
        let (inherited, given_back, still) = thread.join().unwrap();
        assert!(!inherited && !still);
        assert!(given_back.is_ok() || given_back == Err(Refusal::NotSupported));
    }

    #[test]
    fn a_panic_comes_out_of_join() {
        let thread = spawn_realtime("servo", 10, || panic!("on purpose")).unwrap();
        assert!(thread.join().is_err());
    }

    #[test]
    fn a_name_with_a_zero_byte_is_an_error() {
        assert_eq!(spawn_realtime("a\0b", 10, || ()).unwrap_err().kind(), io::ErrorKind::InvalidInput);
    }
}
