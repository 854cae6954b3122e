//! The functions of a recording.

use crate::caller::{Out, Text};
use crate::code::Code;
use crate::handle::Handle;
use crate::session::with_main;
use std::path::Path;

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_record(session: Handle, path: Text) -> Code {
    with_main(session, |side| {
        side.session.record(Path::new(path.read()?))?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_record_stop(session: Handle, ticks: Out<u64>, lost: Out<u64>) -> Code {
    with_main(session, |side| {
        ticks.check()?;
        lost.check()?;
        let recorded = side.session.stop_recording()?;
        ticks.put(recorded.ticks)?;
        lost.put(recorded.lost)?;
        Ok(Code::OK)
    })
}
