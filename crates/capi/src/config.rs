//! `hapflow_session_config`: what a session is made of.

use crate::caller::{In, LogFunction, LogUser, Out, Record, Text};
use crate::code::{Code, Failure};
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use crate::generated::HAPFLOW_MAX_TOOLS;
use crate::handle::{DeviceHandle, Id, SceneHandle};
use crate::log::Log;
use crate::scene_source::SceneSource;
use crate::table::LIBRARY;
use hapflow_engine::{Drive, Scene};
use std::ffi::c_void;

const KIND: u32 = c::HAPFLOW_KIND_SESSION_CONFIG;
/// Ticks that a recording may fall behind: eight seconds.
const TAPE: usize = 8192;
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
    servo_drive: u32,
    device_count: u32,
    devices: In<DeviceHandle>,
    log: LogFunction,
    log_user: LogUser,
    record: u32,
    reserved: u32,
    built: SceneHandle,
}

as_in_header!(
    SessionConfig = hapflow_session_config {
        kind,
        size,
        next,
        scene,
        toml,
        toml_length,
        settings,
        threads,
        fluid_drive,
        servo_drive,
        device_count,
        devices,
        log,
        log_user,
        record,
        reserved,
        built,
    }
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
        servo_drive: c::HAPFLOW_DRIVE_HOST,
        device_count: 0,
        devices: In::NULL,
        log: LogFunction::NULL,
        log_user: LogUser::NULL,
        record: 0,
        reserved: 0,
        built: SceneHandle { id: Id::NULL },
    };

    /// Refuses what this version does not know.
    pub fn check(&self) -> Result<(), Failure> {
        check_head(self.kind, KIND, self.next)?;
        if self.reserved != 0 {
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
        drive("fluid_drive", self.fluid_drive)
    }

    /// Who ticks the servo.
    pub fn servo_drive(&self) -> Result<Drive, Failure> {
        drive("servo_drive", self.servo_drive)
    }

    /// Ticks that a recording may fall behind; 0 without one.
    pub fn tape(&self) -> Result<usize, Failure> {
        match self.record {
            0 => Ok(0),
            1 => Ok(TAPE),
            other => {
                let text = format!("record = {other}: must be 0 or 1");
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
        let Self { scene, toml, toml_length, settings, .. } = *self;
        SceneSource { scene, toml, toml_length, settings }.read(self.built()?)
    }

    /// The log of a session with so many tools.
    pub fn log(&self, scene: &Scene) -> Result<Option<Log>, Failure> {
        Log::open(self.log, self.log_user, scene)
    }

    /// A copy of the scene that was built by calls, if it is one.
    fn built(&self) -> Result<Option<Scene>, Failure> {
        if self.built.id == Id::NULL {
            return Ok(None);
        }
        if !self.scene.is_null() || !self.toml.is_null() {
            let text = "only one of scene, toml and built may be given".into();
            return Err(Failure { code: Code::ERROR_SCENE, text });
        }
        Ok(Some(LIBRARY.scenes.enter(self.built)?.scene()?.clone()))
    }

    /// The devices of an owned servo that the host gives.
    pub fn devices(&self) -> Result<Vec<DeviceHandle>, Failure> {
        let most = if self.servo_drive()? == Drive::Owned { HAPFLOW_MAX_TOOLS } else { 0 };
        if self.device_count > most {
            let text =
                format!("device_count = {}: must be a whole number from 0 to {most}", self.device_count);
            return Err(Failure { code: Code::ERROR_VALUE, text });
        }
        if self.device_count == 0 {
            Ok(Vec::new())
        } else {
            Ok(self.devices.several(self.device_count as usize)?)
        }
    }
}

/// Refuses a configuration of another kind, and one with a struct behind it: none is known.
pub fn check_head(kind: u32, expected: u32, next: *const c_void) -> Result<(), Failure> {
    if kind != expected {
        return Err(Code::ERROR_STRUCT.into());
    }
    if next.is_null() { Ok(()) } else { Err(Code::ERROR_UNSUPPORTED.into()) }
}

fn drive(field: &str, word: u32) -> Result<Drive, Failure> {
    match word {
        c::HAPFLOW_DRIVE_HOST => Ok(Drive::Host),
        c::HAPFLOW_DRIVE_OWNED => Ok(Drive::Owned),
        other => {
            let text = format!("{field} = {other}: must be HAPFLOW_DRIVE_HOST or HAPFLOW_DRIVE_OWNED");
            Err(Failure { code: Code::ERROR_UNSUPPORTED, text })
        }
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_config_init(config: Out<SessionConfig>, size: u32) -> Code {
    fence(|| config.init(&SessionConfig::DEFAULT, size).map(|()| Code::OK))
}
