//! Versions, texts of results, and the last error.

use crate::caller::{Buffer, Out};
use crate::code::{Code, Failure};
use crate::fence::{fence, fence_main};
use crate::generated::HAPFLOW_ABI_VERSION;
use crate::table::LIBRARY;
use std::cell::RefCell;
use std::ffi::c_char;

/// The versions of the ABI that this library speaks.
pub const OLDEST_ABI: u32 = 1;
pub const NEWEST_ABI: u32 = HAPFLOW_ABI_VERSION;

thread_local! {
    static LAST_ERROR: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Keeps what went wrong in a [main] function, for the thread that called it.
pub fn set_last_error(text: String) {
    LAST_ERROR.with(|last| last.replace(text));
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_negotiate(oldest: u32, newest: u32, chosen: Out<u32>) -> Code {
    fence_main(|| {
        chosen.check()?;
        let best = newest.min(NEWEST_ABI);
        if best < oldest.max(OLDEST_ABI) {
            let text = format!(
                "the host wants version {oldest} to {newest} of the interface, this library has {OLDEST_ABI} to \
                 {NEWEST_ABI}"
            );
            return Err(Failure { code: Code::ERROR_VERSION, text });
        }
        LIBRARY.agree(best);
        chosen.put(best)?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_version() -> u32 {
    const fn number(text: &str) -> u32 {
        let (bytes, mut value, mut at) = (text.as_bytes(), 0, 0);
        while at < bytes.len() {
            value = value * 10 + (bytes[at] - b'0') as u32;
            at += 1;
        }
        value
    }
    const MAJOR: u32 = number(env!("CARGO_PKG_VERSION_MAJOR"));
    const MINOR: u32 = number(env!("CARGO_PKG_VERSION_MINOR"));
    const PATCH: u32 = number(env!("CARGO_PKG_VERSION_PATCH"));
    MAJOR * 1_000_000 + MINOR * 1000 + PATCH
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_result_text(result: Code) -> *const c_char {
    result.text().as_ptr()
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_last_error(text: Buffer<c_char>, capacity: usize, length: Out<usize>) -> Code {
    fence(|| LAST_ERROR.with(|last| text.enumerate_text(capacity, length, &last.borrow())))
}
