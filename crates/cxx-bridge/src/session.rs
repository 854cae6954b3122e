//! A session, whose C functions these are by name; each keeps its thread class.

use crate::fence::{Failure, fence};
use crate::ffi::Config;
use crate::generated::*;
use cxx::{ExternType, kind, type_id};
use std::ffi::{CStr, CString, c_char};
use std::mem::{size_of, zeroed};
use std::ptr;

/// Structs of the C header, in their own layout on both sides.
macro_rules! struct_of_the_header {
    ($($name:ident),*) => {$(
        // SAFETY: plain numbers, of the same layout in both languages.
        unsafe impl ExternType for $name {
            type Id = type_id!($name);
            type Kind = kind::Trivial;
        }
    )*};
}
struct_of_the_header!(hapflow_tool_state, hapflow_wrench, hapflow_report);

type Outcome<T> = Result<T, Failure>;

/// A session that is destroyed with this, or another's, that is not.
pub struct Session {
    session: hapflow_session,
    owned: bool,
}

impl Drop for Session {
    fn drop(&mut self) {
        if self.owned {
            // A failure says that it is gone already.
            let _ = self.destroy();
        }
    }
}

/// Makes a session.
pub fn open(config: &Config<'_>) -> Outcome<Box<Session>> {
    fence(|| {
        let mut session = hapflow_session { id: 0 };
        let texts = [config.scene, config.toml, config.settings].map(c_text);
        let [scene, toml, settings] = texts;
        let (scene, toml, settings) = (scene?, toml?, settings?);
        let given = |text: &CString| if text.is_empty() { ptr::null() } else { text.as_ptr() };
        // SAFETY: the init function makes a configuration of zeros, as large as its size says; the texts outlive the calls.
        let result = unsafe {
            let mut chosen = 0;
            plain(hapflow_negotiate(HAPFLOW_ABI_VERSION, HAPFLOW_ABI_VERSION, &mut chosen))?;
            let mut c: hapflow_session_config = zeroed();
            plain(hapflow_session_config_init(&mut c, size_of::<hapflow_session_config>() as u32))?;
            (c.scene, c.toml, c.settings) = (given(&scene), given(&toml), given(&settings));
            c.built.id = config.built;
            c.threads = config.threads;
            c.fluid_drive = config.fluid_drive;
            c.record = config.record.into();
            hapflow_session_create(&c, &mut session)
        };
        told(result)?;
        Ok(Box::new(Session { session, owned: true }))
    })
}

/// A session of the C interface, whoever made it; it stays theirs.
pub fn share(handle: u64) -> Outcome<Box<Session>> {
    fence(|| {
        let shared = Session { session: hapflow_session { id: handle }, owned: false };
        shared.tools()?;
        Ok(Box::new(shared))
    })
}

// SAFETY, of every call below: a handle is a number, and a bad one is refused; pointers are those of references and of
// slices with their length, which are not looked at after the call.
#[allow(clippy::undocumented_unsafe_blocks)]
impl Session {
    pub fn handle(&self) -> Outcome<u64> {
        Ok(self.session.id)
    }

    pub fn destroy(&self) -> Outcome<()> {
        fence(|| told(unsafe { hapflow_session_destroy(self.session) }))
    }

    pub fn tick(&self, state: &hapflow_tool_state, wrench: &mut hapflow_wrench) -> Outcome<i32> {
        fence(|| Ok(unsafe { hapflow_servo_tick(self.session, state, wrench) }))
    }

    pub fn emergency_stop(&self) -> Outcome<i32> {
        fence(|| Ok(unsafe { hapflow_session_emergency_stop(self.session) }))
    }

    pub fn clear_faults(&self) -> Outcome<i32> {
        fence(|| Ok(unsafe { hapflow_session_clear_faults(self.session) }))
    }

    pub fn limit_force(&self, max_force: f64, max_torque: f64) -> Outcome<i32> {
        fence(|| Ok(unsafe { hapflow_session_limit_force(self.session, max_force, max_torque) }))
    }

    pub fn move_obstacle(&self, index: u32, position: &[f64; 3], orientation: &[f64; 4]) -> Outcome<i32> {
        let (position, orientation) = (position.as_ptr(), orientation.as_ptr());
        fence(|| Ok(unsafe { hapflow_obstacle_move(self.session, index, position, orientation) }))
    }

    pub fn publish_obstacles(&self) -> Outcome<i32> {
        fence(|| Ok(unsafe { hapflow_obstacle_publish(self.session) }))
    }

    pub fn fluid_advance(&self, time_s: f64) -> Outcome<()> {
        fence(|| plain(unsafe { hapflow_fluid_advance(self.session, time_s) }))
    }

    pub fn fluid_step(&self, end_s: f64) -> Outcome<()> {
        fence(|| plain(unsafe { hapflow_fluid_step(self.session, end_s) }))
    }

    pub fn particles(&self, positions: &mut [f32]) -> Outcome<usize> {
        let mut count = 0;
        let (to, room) = room_in(positions);
        fence(|| plain(unsafe { hapflow_fluid_particles(self.session, to, room, &mut count) }))?;
        Ok(count)
    }

    pub fn latest_particles(&self, positions: &mut [f32]) -> Outcome<usize> {
        let mut count = 0;
        let (to, room) = room_in(positions);
        fence(|| told(unsafe { hapflow_session_particles(self.session, to, room, &mut count) }))?;
        Ok(count)
    }

    pub fn tool_count(&self) -> Outcome<u32> {
        fence(|| self.tools())
    }

    fn tools(&self) -> Outcome<u32> {
        let mut count = 0;
        plain(unsafe { hapflow_session_tool_count(self.session, &mut count) })?;
        Ok(count)
    }

    pub fn obstacle_count(&self) -> Outcome<u32> {
        let mut count = 0;
        fence(|| plain(unsafe { hapflow_obstacle_count(self.session, &mut count) }))?;
        Ok(count)
    }

    pub fn report(&self, tool: u32, report: &mut hapflow_report) -> Outcome<()> {
        fence(|| {
            plain(unsafe { hapflow_report_init(report, size_of::<hapflow_report>() as u32) })?;
            told(unsafe { hapflow_session_report_of(self.session, tool, report) })
        })
    }

    pub fn set_number(&self, path: &str, value: f64) -> Outcome<()> {
        fence(|| told(unsafe { hapflow_session_set(self.session, c_text(path)?.as_ptr(), value) }))
    }

    pub fn set_text(&self, path: &str, value: &str) -> Outcome<()> {
        fence(|| {
            let (path, value) = (c_text(path)?, c_text(value)?);
            told(unsafe { hapflow_session_set_text(self.session, path.as_ptr(), value.as_ptr()) })
        })
    }

    pub fn get_number(&self, path: &str) -> Outcome<f64> {
        let mut value = 0.0;
        fence(|| told(unsafe { hapflow_session_get(self.session, c_text(path)?.as_ptr(), &mut value) }))?;
        Ok(value)
    }

    pub fn get_text(&self, path: &str) -> Outcome<String> {
        fence(|| {
            let path = c_text(path)?;
            whole_text(|text, capacity, length| unsafe {
                hapflow_session_get_text(self.session, path.as_ptr(), text, capacity, length)
            })
        })
    }
}

/// Where particles go, and how many: null for none.
fn room_in(positions: &mut [f32]) -> (*mut f32, usize) {
    let room = positions.len() / 3;
    (if room == 0 { ptr::null_mut() } else { positions.as_mut_ptr() }, room)
}

/// A text for C, which ends at its first NUL.
fn c_text(text: &str) -> Outcome<CString> {
    CString::new(text)
        .map_err(|_| Failure { code: HAPFLOW_ERROR_TEXT, text: "a text with a NUL inside".into() })
}

/// Of functions that leave no message.
fn plain(result: i32) -> Outcome<()> {
    if result >= 0 {
        return Ok(());
    }
    // SAFETY: the texts of results last as long as the process.
    let text = unsafe { CStr::from_ptr(hapflow_result_text(result)) };
    Err(Failure { code: result, text: text.to_string_lossy().into_owned() })
}

/// Of \[main\] functions, which leave one.
fn told(result: i32) -> Outcome<()> {
    if result >= 0 {
        return Ok(());
    }
    // SAFETY: a buffer and its length, or null and none.
    let text = whole_text(|text, capacity, length| unsafe { hapflow_last_error(text, capacity, length) })?;
    if text.is_empty() { plain(result) } else { Err(Failure { code: result, text }) }
}

/// The text that `read(buffer, capacity, &length)` gives: by two calls, or more if it grows meanwhile.
fn whole_text(read: impl Fn(*mut c_char, usize, *mut usize) -> i32) -> Outcome<String> {
    let (mut text, mut length) = (Vec::<u8>::new(), 0);
    plain(read(ptr::null_mut(), 0, &mut length))?;
    while length >= text.len() {
        text.resize(length + 1, 0);
        plain(read(text.as_mut_ptr().cast(), text.len(), &mut length))?;
    }
    text.truncate(length);
    Ok(String::from_utf8_lossy(&text).into_owned())
}
