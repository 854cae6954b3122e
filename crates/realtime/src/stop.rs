//! Being asked to stop: Ctrl-C, and what a system sends to programs that are to end.

use crate::os;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Takes note of what ends programs instead of ending at once, so that the one who looks at [`stop_asked`] can take the force
/// off first: on Unix the signals interrupt, terminate and hang-up, on Windows Ctrl-C, Ctrl-Break and the end of the console
/// (which waits 5 s). The second of a kind ends the program as ever.
///
/// False where the system has none of these, or refuses: they then end the program. Thread: main.
pub fn catch_stop() -> bool {
    os::catch_stop()
}

/// Whether such a signal has come since [`catch_stop`]. Thread: any.
#[must_use]
pub fn stop_asked() -> bool {
    ASKED.load(Ordering::Acquire)
}

/// One has come. Only sets an atomic, as signal handlers must.
pub(crate) fn note() {
    ASKED.store(true, Ordering::Release);
}
