//! A way for the tests to make a call panic. Without the feature `test-hooks` it is nothing.

#[cfg(not(feature = "test-hooks"))]
pub fn panic_if_asked() {}

#[cfg(feature = "test-hooks")]
pub use armed::panic_if_asked;

#[cfg(feature = "test-hooks")]
mod armed {
    use std::cell::Cell;

    thread_local! {
        static ASKED: Cell<bool> = const { Cell::new(false) };
    }

    #[expect(clippy::panic, reason = "that is what it is for")]
    pub fn panic_if_asked() {
        if ASKED.replace(false) {
            std::panic::panic_any("asked for by a test");
        }
    }

    /// The next call of a session's function on this thread panics.
    #[unsafe(no_mangle)]
    pub extern "C" fn hapflow_test_panic_next_call() {
        ASKED.set(true);
    }
}
