//! Being asked to stop: Ctrl-C, and what a system sends to programs that are to end.

use crate::os;

/// Takes note of the signals that end programs (interrupt, terminate, hang-up) instead of ending at once, so that the one
/// who looks at [`stop_asked`] can take the force off first. A second signal of a kind ends the program as ever.
///
/// False where the system has no such signals, or refuses: they then end the program. Thread: main.
pub fn catch_stop() -> bool {
    os::catch_stop()
}

/// Whether such a signal has come since [`catch_stop`]. Thread: any.
#[must_use]
pub fn stop_asked() -> bool {
    os::stop_asked()
}
