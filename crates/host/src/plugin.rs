//! A library of the C interface, loaded by name.

use crate::generated::{
    Functions, hapflow_session, hapflow_session_config, hapflow_tool_state, hapflow_wrench,
};
use std::error::Error;
use std::ffi::CString;
use std::mem::size_of;
use std::path::Path;
use std::ptr;

/// Why a library cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum PluginError {
    /// It is no library, or lacks a function of the interface.
    #[error("{}: {}", .0, reason(.1))]
    Load(String, libloading::Error),
    /// It is one, but cannot be used.
    #[error("{0}: {1}")]
    Refused(String, String),
}

/// What the system says of it, where it says something.
fn reason(error: &libloading::Error) -> String {
    error.source().map_or_else(|| error.to_string(), ToString::to_string)
}

/// A library with every function of `include/hapflow/`. It stays loaded as long as the process: its threads may outlast
/// whoever loaded it.
#[derive(Clone, Copy)]
pub struct Plugin {
    pub(crate) functions: &'static Functions,
}

impl Plugin {
    /// Loads it, and looks up all functions.
    ///
    /// # Errors
    /// [`PluginError`] with the file, and what is wrong or missing. What a library does while it is loaded nobody can check.
    pub fn load(file: &Path) -> Result<Self, PluginError> {
        // SAFETY: the caller names a library that is to run in this process; it is never unloaded.
        let functions = unsafe { Functions::new(file) };
        let functions = functions.map_err(|e| PluginError::Load(file.display().to_string(), e))?;
        Ok(Self { functions: Box::leak(Box::new(functions)) })
    }

    /// Agrees on a version of the interface within a range; the result, and the version.
    pub(crate) fn negotiate(self, oldest: u32, newest: u32) -> (i32, u32) {
        let mut chosen = 0;
        // SAFETY: `chosen` is there to be written.
        let result = unsafe { self.functions.hapflow_negotiate(oldest, newest, &mut chosen) };
        (result, chosen)
    }

    /// Makes a session of the text of a scene file.
    pub(crate) fn create(self, scene: &str) -> (i32, hapflow_session) {
        let mut session = hapflow_session { id: 0 };
        let Ok(toml) = CString::new(scene) else { return (i32::MIN, session) };
        // SAFETY: plain numbers and null pointers, of which the init function makes a configuration.
        let mut config: hapflow_session_config = unsafe { std::mem::zeroed() };
        // SAFETY: `config` is as large as its size says, and the text outlives the call.
        let result = unsafe {
            self.functions
                .hapflow_session_config_init(&mut config, size_of::<hapflow_session_config>() as u32);
            config.toml = toml.as_ptr();
            config.threads = 1;
            self.functions.hapflow_session_create(&config, &mut session)
        };
        (result, session)
    }

    /// Ends a session.
    pub(crate) fn destroy(self, session: hapflow_session) -> i32 {
        // SAFETY: a handle is a number; a bad one is refused.
        unsafe { self.functions.hapflow_session_destroy(session) }
    }

    /// A tool at rest in the origin, at a time.
    pub(crate) fn state(self, time_s: f64) -> hapflow_tool_state {
        // SAFETY: plain numbers, of which the init function makes a state as large as its size says.
        let mut state = unsafe {
            let mut state: hapflow_tool_state = std::mem::zeroed();
            self.functions.hapflow_tool_state_init(&mut state, size_of::<hapflow_tool_state>() as u32);
            state
        };
        state.time_s = time_s;
        state
    }

    /// Steps the fluid to the state's time.
    pub(crate) fn advance(self, session: hapflow_session, time_s: f64) -> i32 {
        // SAFETY: numbers alone.
        unsafe { self.functions.hapflow_fluid_advance(session, time_s) }
    }

    /// A tick, and the six numbers that it wrote: NaN where it wrote none.
    pub(crate) fn tick(
        self,
        session: hapflow_session,
        state: Option<&hapflow_tool_state>,
    ) -> (i32, [f64; 6]) {
        let mut wrench = hapflow_wrench { force: [f64::NAN; 3], torque: [f64::NAN; 3] };
        let state = state.map_or(ptr::null(), ptr::from_ref);
        // SAFETY: `state` is null, which is refused, or a state; `wrench` is there to be written.
        let result = unsafe { self.functions.hapflow_servo_tick(session, state, &mut wrench) };
        let ([a, b, c], [d, e, f]) = (wrench.force, wrench.torque);
        (result, [a, b, c, d, e, f])
    }

    /// Takes back every fault.
    pub(crate) fn clear_faults(self, session: hapflow_session) -> i32 {
        // SAFETY: a handle is a number; a bad one is refused.
        unsafe { self.functions.hapflow_session_clear_faults(session) }
    }
}
