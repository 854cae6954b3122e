//! Being asked to stop on Linux, macOS and other Unix systems: `sigaction(2)`.

use crate::stop::note;
use std::{mem, ptr};

extern "C" fn note_stop(_signal: libc::c_int) {
    // All that a signal handler may do.
    note();
}

/// Notes the first of each signal; the next of that kind acts as ever.
pub(crate) fn catch_stop() -> bool {
    // SAFETY: the zeroed action is valid, and its handler only sets an atomic; null asks for no old action.
    unsafe {
        let mut action: libc::sigaction = mem::zeroed();
        action.sa_sigaction = note_stop as *const () as libc::sighandler_t;
        action.sa_flags = libc::SA_RESETHAND | libc::SA_RESTART;
        libc::sigemptyset(&mut action.sa_mask);
        [libc::SIGINT, libc::SIGTERM, libc::SIGHUP]
            .into_iter()
            .all(|signal| libc::sigaction(signal, &action, ptr::null_mut()) == 0)
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;
    use crate::stop_asked;

    #[test]
    fn a_signal_is_noted_and_the_program_goes_on() {
        assert!(catch_stop() && !stop_asked());
        // SAFETY: the handler is in place.
        assert_eq!(unsafe { libc::raise(libc::SIGHUP) }, 0);
        assert!(stop_asked());
    }
}
