//! Results, as the header numbers them. A number is never used again for something else.

use crate::generated as c;
use hapflow_devices::DeviceError;
use hapflow_devices::falcon::FalconError;
use hapflow_engine::SceneError;
use std::ffi::CStr;

/// A result: negative failed, zero done, positive a remark.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Code(pub i32);

/// What every entry comes to. Both sides are codes; the failure is never positive.
pub type Outcome = Result<Code, Code>;

macro_rules! codes {
    ($($name:ident = $number:ident, $text:literal;)+) => {
        impl Code {
            $(pub const $name: Self = Self(c::$number);)+

            /// Every result, with a sentence on it.
            const ALL: &[(Self, &'static CStr)] = &[$((Self::$name, $text)),+];
        }
    };
}

codes! {
    OK = HAPFLOW_OK, c"done";
    REMARK_FORCE_HELD = HAPFLOW_REMARK_FORCE_HELD, c"done, and a fault holds the force at zero until it is cleared";
    REMARK_NO_TIME = HAPFLOW_REMARK_NO_TIME, c"done, but the tick took no time, so that the force stayed as it was";
    REMARK_LATE = HAPFLOW_REMARK_LATE, c"done, but the tick came late, and the force changes as in a tick of 10 ms";
    REMARK_MORE = HAPFLOW_REMARK_MORE, c"done, but there is more than the buffer holds";
    ERROR_PANIC = HAPFLOW_ERROR_PANIC, c"a panic inside the library; the session is faulted";
    ERROR_NOT_NEGOTIATED = HAPFLOW_ERROR_NOT_NEGOTIATED, c"hapflow_negotiate comes before anything else";
    ERROR_VERSION = HAPFLOW_ERROR_VERSION, c"no common version of the ABI";
    ERROR_NULL = HAPFLOW_ERROR_NULL, c"a pointer that must not be null is";
    ERROR_HANDLE = HAPFLOW_ERROR_HANDLE, c"the session, device or scene is null, was destroyed or closed, or never was";
    ERROR_BUSY = HAPFLOW_ERROR_BUSY, c"another thread is in a function of this class, for this session, tool, device or scene";
    ERROR_FULL = HAPFLOW_ERROR_FULL, c"as many sessions, devices or scenes as there can be";
    ERROR_STRUCT = HAPFLOW_ERROR_STRUCT, c"the kind or size of a struct is wrong: was it initialised?";
    ERROR_UNSUPPORTED = HAPFLOW_ERROR_UNSUPPORTED, c"something that this version does not know";
    ERROR_TEXT = HAPFLOW_ERROR_TEXT, c"a text that is not UTF-8";
    ERROR_SCENE = HAPFLOW_ERROR_SCENE, c"the scene cannot be read or run";
    ERROR_NOT_FOUND = HAPFLOW_ERROR_NOT_FOUND, c"no shipped scene and no file of that name";
    ERROR_SETTING = HAPFLOW_ERROR_SETTING, c"no setting of that path";
    ERROR_VALUE = HAPFLOW_ERROR_VALUE, c"a value outside its range or of the wrong type";
    ERROR_FIXED = HAPFLOW_ERROR_FIXED, c"a setting that cannot change while a session runs";
    ERROR_NOT_FINITE = HAPFLOW_ERROR_NOT_FINITE, c"a number that is NaN or infinite";
    ERROR_ORIENTATION = HAPFLOW_ERROR_ORIENTATION, c"an orientation that is not a unit quaternion within 1e-3";
    ERROR_TIME = HAPFLOW_ERROR_TIME, c"a time that goes back, is negative, or is too far ahead";
    ERROR_FAULTED = HAPFLOW_ERROR_FAULTED, c"the fluid, or the scene, panicked before; only destroying is left";
    ERROR_INDEX = HAPFLOW_ERROR_INDEX, c"an index that is not below the count";
    ERROR_DRIVE = HAPFLOW_ERROR_DRIVE, c"the session's own thread does that: tick the servo, or step the fluid";
    ERROR_DEVICE = HAPFLOW_ERROR_DEVICE, c"the device cannot be opened, or does not answer any more";
    ERROR_FILE = HAPFLOW_ERROR_FILE, c"a file cannot be written";
    ERROR_RECORDING = HAPFLOW_ERROR_RECORDING, c"there is a recording, there is none, or the session was made without";
}

impl Code {
    /// A sentence on it.
    pub fn text(self) -> &'static CStr {
        Self::ALL.iter().find(|c| c.0 == self).map_or(c"a result that this library does not know", |c| c.1)
    }
}

/// A failure of a [main] function: its result, and what exactly was wrong.
pub struct Failure {
    pub code: Code,
    pub text: String,
}

impl Failure {
    /// There is no such index.
    pub fn index(what: &str, index: u32, count: u32) -> Self {
        Self { code: Code::ERROR_INDEX, text: format!("no {what} {index}: there are {count}, from 0") }
    }
}

impl From<Code> for Failure {
    fn from(code: Code) -> Self {
        Self { code, text: code.text().to_string_lossy().into_owned() }
    }
}

fn of_device(error: &DeviceError) -> Code {
    match error {
        DeviceError::Unknown { .. } => Code::ERROR_NOT_FOUND,
        DeviceError::Unavailable { .. }
        | DeviceError::Refused { .. }
        | DeviceError::Lost { .. }
        | DeviceError::Closed { .. } => Code::ERROR_DEVICE,
        DeviceError::Falcon(FalconError::Firmware(_) | FalconError::Geometry(_)) => Code::ERROR_VALUE,
        DeviceError::Falcon(_) => Code::ERROR_DEVICE,
        DeviceError::Setting(_) => Code::ERROR_VALUE,
        DeviceError::Motion(_) | DeviceError::Script(_) => Code::ERROR_SCENE,
    }
}

impl From<DeviceError> for Failure {
    fn from(error: DeviceError) -> Self {
        SceneError::from(error).into()
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let code = match &error {
            SceneError::NotFound { .. } => Code::ERROR_NOT_FOUND,
            SceneError::UnknownSetting { .. } => Code::ERROR_SETTING,
            SceneError::Device(error) => of_device(error),
            SceneError::NotLive(_) => Code::ERROR_FIXED,
            SceneError::Io { .. } => Code::ERROR_FILE,
            SceneError::Recording(_) => Code::ERROR_RECORDING,
            SceneError::BadValue { .. }
            | SceneError::Fluid(_)
            | SceneError::Range(_)
            | SceneError::Filter(_) => Code::ERROR_VALUE,
            _ => Code::ERROR_SCENE,
        };
        Self { code, text: error.to_string() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_result_of_the_header_has_a_text() {
        let generated = include_str!("generated.rs");
        let result = |line: &&str| {
            ["OK", "REMARK_", "ERROR_"]
                .iter()
                .any(|kind| line.starts_with(&format!("pub const HAPFLOW_{kind}")))
        };
        assert_eq!(generated.lines().filter(result).count(), Code::ALL.len());
    }

    #[test]
    fn numbers_and_texts_are_apart() {
        for (n, (code, text)) in Code::ALL.iter().enumerate() {
            assert!(Code::ALL[..n].iter().all(|c| c.0 != *code && c.1 != *text));
        }
    }
}
