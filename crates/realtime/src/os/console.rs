//! Being asked to stop on Windows: `SetConsoleCtrlHandler` of the console API.

use crate::stop::{note, stop_asked};
use std::{thread, time::Duration};

/// The events of a handler: a key, and the end of console, session or system.
const CTRL_C: u32 = 0;
const CTRL_BREAK: u32 = 1;
/// How long the system waits for a program when the console, session or system ends.
const GRACE: Duration = Duration::from_secs(5);

#[link(name = "kernel32")]
unsafe extern "system" {
    safe fn SetConsoleCtrlHandler(handler: extern "system" fn(u32) -> i32, add: i32) -> i32;
}

/// Called by the system in a thread of its own; 1 says that the event is dealt with, 0 lets it end the program.
extern "system" fn note_stop(event: u32) -> i32 {
    if matches!(event, CTRL_C | CTRL_BREAK) {
        let again = stop_asked();
        note();
        return i32::from(!again);
    }
    note();
    // The program is ended once this returns: until then it may take the force off and end by itself.
    thread::sleep(GRACE);
    1
}

/// Notes the first Ctrl-C, and the end of the console; the next Ctrl-C acts as ever.
pub(crate) fn catch_stop() -> bool {
    SetConsoleCtrlHandler(note_stop, 1) != 0
}
