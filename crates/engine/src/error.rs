//! What the engine refuses, and why.

use hapflow_devices::{DeviceError, MotionError, ScriptError};
use hapflow_fluid::FluidError;
use hapflow_haptics::{FilterError, RangeError};
use std::io;
use std::path::PathBuf;

/// A scene, a setting or a session that cannot be.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// No shipped scene and no file of that name.
    #[error("no scene \"{name}\": not a shipped one ({shipped}) and not a readable file ({cause})")]
    NotFound {
        /// What was asked for.
        name: String,
        /// Names of the shipped ones.
        shipped: String,
        /// Why the file could not be read.
        cause: io::Error,
    },
    /// Something wrong in a scene file.
    #[error("{file}:{line}: {what}")]
    File {
        /// Name of the file or scene.
        file: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong: field, value and allowed range.
        what: String,
    },
    /// No setting of that path.
    #[error("no setting \"{path}\"{hint}")]
    UnknownSetting {
        /// What was asked for.
        path: String,
        /// The nearest name, or where to find them.
        hint: String,
    },
    /// A value that does not fit a setting.
    #[error("{path} = {value}: must be {expected}")]
    BadValue {
        /// The setting.
        path: String,
        /// The value.
        value: String,
        /// What it must be.
        expected: String,
    },
    /// A setting that holds for a whole session.
    #[error("{0} cannot change while a session runs: set it before it starts")]
    NotLive(String),
    /// What the fluid refuses.
    #[error(transparent)]
    Fluid(#[from] FluidError),
    /// What gate, hand or mapping refuse.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// A filter that cannot be.
    #[error("filter: {0}")]
    Filter(#[from] FilterError),
    /// A device that cannot be.
    #[error("device: {0}")]
    Device(#[from] DeviceError),
    /// A motion that cannot be read.
    #[error("motion: {0}")]
    Motion(#[from] MotionError),
    /// A hand's script that cannot be.
    #[error("hand: {0}")]
    Script(#[from] ScriptError),
    /// Anything else, said in full.
    #[error("{0}")]
    Refused(String),
    /// A file that could not be written or read.
    #[error("{path}: {cause}")]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// A recording that cannot begin or end now.
    #[error("recording: {0}")]
    Recording(&'static str),
    /// A thread that could not be started.
    #[error("could not start the {name} thread: {cause}")]
    Thread {
        /// Which.
        name: &'static str,
        /// Why.
        cause: io::Error,
    },
}
