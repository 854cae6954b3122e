//! What ends a run early: Ctrl-C and its like, or the Enter key.

use hapflow_realtime::{catch_stop, stop_asked};
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether somebody wants to stop.
pub struct Stop {
    key: Arc<AtomicBool>,
}

impl Stop {
    /// Looks out for signals and, with `keyboard` and a terminal, for the Enter key.
    pub fn arm(keyboard: bool) -> Self {
        catch_stop();
        let key = Arc::new(AtomicBool::new(false));
        if keyboard && std::io::stdin().is_terminal() {
            eprintln!("Enter or Ctrl-C takes the force off and ends the run");
            let pressed = Arc::clone(&key);
            // It ends with the program: nothing can take a thread out of reading a terminal.
            std::thread::spawn(move || {
                let _ = std::io::stdin().read_line(&mut String::new());
                pressed.store(true, Ordering::Release);
            });
        }
        Self { key }
    }

    /// Whether to go on.
    pub fn flow(&self) -> ControlFlow<()> {
        if stop_asked() || self.key.load(Ordering::Acquire) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}
