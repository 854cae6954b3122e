//! Keeping the memory of the process from being swapped out.
//!
//! A page that must come from disk makes a servo tick late by milliseconds. Source: Linux manual, `mlockall(2)`.

use crate::{os, status::Refusal};

/// Locks all memory of the process, present and future, into RAM.
///
/// It concerns the whole process, so a library asks its host before it does this; memory that is only reserved
/// (thread stacks) then takes RAM too. Done only without a limit: under one, an allocation past it would later
/// abort the process. To that end the limit is lifted (`RLIMIT_MEMLOCK`) where the user may do so. Calling it again
/// is harmless.
///
/// Thread: main (may take long: all pages are brought in).
///
/// # Errors
/// A [`Refusal`] that says what to do; nothing is locked then.
pub fn lock_memory() -> Result<(), Refusal> {
    os::lock_memory()
}

/// Undoes [`lock_memory`], and any other lock of the process; the lifted limit stays.
///
/// Thread: main.
///
/// # Errors
/// [`Refusal::NotSupported`] where this crate locks no memory, [`Refusal::System`] otherwise.
pub fn unlock_memory() -> Result<(), Refusal> {
    os::unlock_memory()
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    /// Holds on machines that grant the lock and on those that refuse it.
    #[test]
    fn locking_works_or_says_why_not_and_is_undone() {
        match lock_memory() {
            Ok(()) => assert_eq!(lock_memory(), Ok(()), "twice is harmless"),
            Err(refusal) => assert!(!refusal.to_string().is_empty()),
        }
        let undone = unlock_memory();
        assert!(undone.is_ok() || undone == Err(Refusal::NotSupported));
    }
}
