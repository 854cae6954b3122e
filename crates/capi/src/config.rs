//! `hapflow_session_config`: what a session is made of.

use crate::caller::{Out, Record, Text};
use crate::code::{Code, Failure};
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use hapflow_engine::{Drive, Scene, Value, load, parse, settings};
use std::ffi::c_void;

const KIND: u32 = c::HAPFLOW_KIND_SESSION_CONFIG;
/// Most worker threads: more is a mistake, and might not come up.
const MOST_THREADS: u32 = 1024;

/// `hapflow_session_config`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SessionConfig {
    kind: u32,
    size: u32,
    next: *const c_void,
    scene: Text,
    toml: Text,
    toml_length: usize,
    settings: Text,
    threads: u32,
    fluid_drive: u32,
}

as_in_header!(
    SessionConfig =
        hapflow_session_config { kind, size, next, scene, toml, toml_length, settings, threads, fluid_drive }
);

// SAFETY: repr(C), no padding with pointers of 4 or 8 bytes; every field takes any bits.
unsafe impl Record for SessionConfig {
    const SIZE_AT: usize = 4;
    const FIRST_SIZE: usize = 16 + 5 * size_of::<usize>();
}

impl SessionConfig {
    /// What the init function writes.
    pub const DEFAULT: Self = Self {
        kind: KIND,
        size: size_of::<Self>() as u32,
        next: std::ptr::null(),
        scene: Text::NULL,
        toml: Text::NULL,
        toml_length: 0,
        settings: Text::NULL,
        threads: 0,
        fluid_drive: c::HAPFLOW_DRIVE_HOST,
    };

    /// Refuses what this version does not know.
    pub fn check(&self) -> Result<(), Failure> {
        if self.kind != KIND {
            return Err(Code::ERROR_STRUCT.into());
        }
        if !self.next.is_null() {
            return Err(Code::ERROR_UNSUPPORTED.into());
        }
        if self.threads > MOST_THREADS {
            let text = format!("threads = {}: must be a whole number from 0 to {MOST_THREADS}", self.threads);
            return Err(Failure { code: Code::ERROR_VALUE, text });
        }
        Ok(())
    }

    /// Who steps the fluid.
    pub fn fluid_drive(&self) -> Result<Drive, Failure> {
        match self.fluid_drive {
            c::HAPFLOW_DRIVE_HOST => Ok(Drive::Host),
            c::HAPFLOW_DRIVE_OWNED => Ok(Drive::Owned),
            other => {
                let text =
                    format!("fluid_drive = {other}: must be HAPFLOW_DRIVE_HOST or HAPFLOW_DRIVE_OWNED");
                Err(Failure { code: Code::ERROR_UNSUPPORTED, text })
            }
        }
    }

    /// Worker threads of the fluid; 0 is all cores but one.
    pub fn threads(&self) -> usize {
        self.threads as usize
    }

    /// The scene, with the settings on top.
    pub fn scene(&self) -> Result<Scene, Failure> {
        let mut scene = match (self.scene.is_null(), self.toml.is_null()) {
            (false, true) => load(self.scene.read()?)?,
            (true, false) => parse(self.toml.read_bytes(self.toml_length)?, "toml")?,
            _ => {
                let text = "exactly one of scene and toml must be given".into();
                return Err(Failure { code: Code::ERROR_SCENE, text });
            }
        };
        if !self.settings.is_null() {
            apply(&mut scene, self.settings.read()?)?;
        }
        Ok(scene)
    }
}

/// Applies lines of `path = value`.
fn apply(scene: &mut Scene, lines: &str) -> Result<(), Failure> {
    for (n, line) in lines.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        set_line(scene, line)
            .map_err(|f| Failure { text: format!("settings:{}: {}", n + 1, f.text), ..f })?;
    }
    Ok(())
}

fn set_line(scene: &mut Scene, line: &str) -> Result<(), Failure> {
    let Some((path, value)) = line.split_once('=') else {
        let text = format!("\"{line}\": must be path = value");
        return Err(Failure { code: Code::ERROR_VALUE, text });
    };
    Ok(settings::set(scene, path.trim(), &Value::parse(value))?)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_config_init(config: Out<SessionConfig>, size: u32) -> Code {
    fence(|| config.init(&SessionConfig::DEFAULT, size).map(|()| Code::OK))
}
