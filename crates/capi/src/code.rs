//! Results, as the header numbers them. A number is never used again for something else.

use hapflow_engine::SceneError;
use std::ffi::CStr;

/// A result: negative failed, zero done, positive a remark.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Code(pub i32);

/// What every entry comes to. Both sides are codes; the failure is never positive.
pub type Outcome = Result<Code, Code>;

macro_rules! codes {
    ($($name:ident = $number:literal, $text:literal;)+) => {
        impl Code {
            $(pub const $name: Self = Self($number);)+

            /// Every result with its name in the header, less `HAPFLOW_`.
            const ALL: &[(&'static str, Self, &'static CStr)] = &[$((stringify!($name), Self::$name, $text)),+];
        }
    };
}

codes! {
    OK = 0, c"done";
    REMARK_FORCE_HELD = 1, c"done, and a fault holds the force at zero until it is cleared";
    REMARK_NO_TIME = 2, c"done, but the tick took no time, so that the force stayed as it was";
    REMARK_LATE = 3, c"done, but the tick came late, and the force changes as in a tick of 10 ms";
    REMARK_MORE = 4, c"done, but there is more than the buffer holds";
    ERROR_PANIC = -1, c"a panic inside the library; the session is faulted";
    ERROR_NOT_NEGOTIATED = -2, c"hapflow_negotiate comes before anything else";
    ERROR_VERSION = -3, c"no common version of the ABI";
    ERROR_NULL = -4, c"a pointer that must not be null is";
    ERROR_HANDLE = -5, c"the session is null, was destroyed, or never was";
    ERROR_BUSY = -6, c"another thread is in a function of this class, for this session";
    ERROR_FULL = -7, c"as many sessions as there can be";
    ERROR_STRUCT = -8, c"the kind or size of a struct is wrong: was it initialised?";
    ERROR_UNSUPPORTED = -9, c"something that this version does not know";
    ERROR_TEXT = -10, c"a text that is not UTF-8";
    ERROR_SCENE = -11, c"the scene cannot be read or run";
    ERROR_NOT_FOUND = -12, c"no shipped scene and no file of that name";
    ERROR_SETTING = -13, c"no setting of that path";
    ERROR_VALUE = -14, c"a value outside its range or of the wrong type";
    ERROR_FIXED = -15, c"a setting that cannot change while a session runs";
    ERROR_NOT_FINITE = -16, c"a number that is NaN or infinite";
    ERROR_ORIENTATION = -17, c"an orientation that is not a unit quaternion within 1e-3";
    ERROR_TIME = -18, c"a time that goes back, is negative, or is too far ahead";
    ERROR_FAULTED = -19, c"the fluid panicked before; only destroying is left";
}

impl Code {
    /// A sentence on it.
    pub fn text(self) -> &'static CStr {
        Self::ALL.iter().find(|c| c.1 == self).map_or(c"a result that this library does not know", |c| c.2)
    }
}

/// A failure of a [main] function: its result, and what exactly was wrong.
pub struct Failure {
    pub code: Code,
    pub text: String,
}

impl From<Code> for Failure {
    fn from(code: Code) -> Self {
        Self { code, text: code.text().to_string_lossy().into_owned() }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let code = match &error {
            SceneError::NotFound { .. } => Code::ERROR_NOT_FOUND,
            SceneError::UnknownSetting { .. } => Code::ERROR_SETTING,
            SceneError::NotLive(_) => Code::ERROR_FIXED,
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

    const HEADER: &str = include_str!("../../../include/hapflow/hapflow.h");

    #[test]
    fn the_header_has_the_same_numbers() {
        for (name, code, _) in Code::ALL {
            let line = format!("HAPFLOW_{name} = {},", code.0);
            assert!(HEADER.contains(&line), "{line}");
        }
        let in_header = HEADER.lines().filter(|l| l.contains("_ERROR_") && l.contains(" = -")).count();
        assert_eq!(in_header, Code::ALL.iter().filter(|c| c.1.0 < 0).count());
    }

    #[test]
    fn numbers_and_texts_are_apart() {
        for (n, (_, code, text)) in Code::ALL.iter().enumerate() {
            assert!(Code::ALL[..n].iter().all(|c| c.1 != *code && c.2 != *text));
        }
    }
}
