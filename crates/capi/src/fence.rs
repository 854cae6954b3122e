//! The one place where panics end: nothing unwinds into a caller's frames.

use crate::code::{Code, Failure, Outcome};
use crate::library::set_last_error;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a [servo], [fluid] or [any] function. Costs nothing while nothing panics.
///
/// Whatever was entered is left, and faulted, while the panic unwinds: see [`hapflow_realtime::Alone`].
pub fn fence(body: impl FnOnce() -> Outcome) -> Code {
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(outcome) => outcome.unwrap_or_else(|code| code),
        Err(payload) => {
            // Its drop might panic again, outside of any fence.
            std::mem::forget(payload);
            Code::ERROR_PANIC
        }
    }
}

/// Runs a [main] function, and keeps what went wrong for `hapflow_last_error`.
pub fn fence_main(body: impl FnOnce() -> Result<Code, Failure>) -> Code {
    let code = fence(|| {
        body().map_err(|failure| {
            set_last_error(failure.text);
            failure.code
        })
    });
    if code == Code::ERROR_PANIC {
        return fence(|| {
            set_last_error("a panic inside the library: please report it".into());
            Err(code)
        });
    }
    code
}
