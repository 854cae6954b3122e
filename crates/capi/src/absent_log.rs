//! The log in a build without it.

use crate::caller::{LogFunction, LogUser};
use crate::code::{Code, Failure};
use crate::handle::Handle;
use hapflow_engine::{Control, Scene, Session};

/// There is none.
pub enum Log {}

impl Log {
    pub fn open(function: LogFunction, _: LogUser, _: &Scene) -> Result<Option<Self>, Failure> {
        if function.is_null() {
            return Ok(None);
        }
        let text = "log: must be null, for this build has no log".into();
        Err(Failure { code: Code::ERROR_UNSUPPORTED, text })
    }

    pub fn poll(&mut self, _: &mut Session, _: &Control) {
        match *self {}
    }
}

/// No thread is ever in a log function.
pub fn check_outside(_: Handle) -> Result<(), Code> {
    Ok(())
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_poll(_: Handle) -> Code {
    Code::ERROR_UNSUPPORTED
}
