//! How a bridged function fails: with an error, and never with a panic, which cxx would end the process for.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What C++ gets as an exception: the result's number, a space, and what was wrong. `hapflow/cxx.hpp` takes it apart.
#[derive(Debug, PartialEq)]
pub struct Failure {
    /// `HAPFLOW_ERROR_...`.
    pub code: i32,
    /// Field, value and allowed range.
    pub text: String,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.code, self.text)
    }
}

/// `HAPFLOW_ERROR_PANIC`.
const PANIC: i32 = -1;

/// Runs the body of a bridged function. Costs nothing while nothing panics.
pub fn fence<T>(body: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| {
        // Its drop might panic again, outside of any fence.
        std::mem::forget(payload);
        Err(Failure { code: PANIC, text: "a panic inside the bridge: please report it".into() })
    })
}
