//! `hapflow_body_config`: something that floats or sinks.

use crate::caller::{Out, Record, Text};
use crate::code::{Code, Failure};
use crate::config::check_head;
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use crate::part::{Part, form_of, name, null, unreserved};
use crate::session::finite;
use glam::DVec3;
use hapflow_engine::FreeBody;
use std::ffi::c_void;

/// `hapflow_body_config`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct BodyConfig {
    kind: u32,
    size: u32,
    next: *const c_void,
    name: Text,
    shape: u32,
    reserved: u32,
    radius: f64,
    thickness: f64,
    density: f64,
    position: [f64; 3],
    length: f64,
    extent: [f64; 3],
    scale: f64,
    file: Text,
    mesh: *const c_void,
}

as_in_header!(
    BodyConfig = hapflow_body_config {
        kind,
        size,
        next,
        name,
        shape,
        reserved,
        radius,
        thickness,
        density,
        position,
        length,
        extent,
        scale,
        file,
        mesh,
    }
);

// SAFETY: repr(C), no padding with pointers of 4 or 8 bytes; every field takes any bits.
unsafe impl Record for BodyConfig {
    const SIZE_AT: usize = 4;
    const FIRST_SIZE: usize = 104 + 4 * size_of::<usize>();
}

impl Part for BodyConfig {
    type Thing = FreeBody;

    const DEFAULT: Self = Self {
        kind: c::HAPFLOW_KIND_BODY_CONFIG,
        size: size_of::<Self>() as u32,
        next: std::ptr::null(),
        name: Text::NULL,
        shape: c::HAPFLOW_SHAPE_SPHERE,
        reserved: 0,
        radius: 0.02,
        thickness: 0.01,
        density: 500.0,
        position: [0.0; 3],
        length: 0.04,
        extent: [0.03; 3],
        scale: 1.0,
        file: Text::NULL,
        mesh: std::ptr::null(),
    };

    fn thing(&self) -> Result<FreeBody, Failure> {
        check_head(self.kind, c::HAPFLOW_KIND_BODY_CONFIG, self.next)?;
        unreserved(self.reserved)?;
        null(self.mesh)?;
        finite("density", &[self.density])?;
        finite("position", &self.position)?;
        Ok(FreeBody {
            name: name(self.name)?,
            form: form_of!(self)?,
            density: self.density,
            position: DVec3::from(self.position),
        })
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_body_config_init(config: Out<BodyConfig>, size: u32) -> Code {
    fence(|| config.init(&BodyConfig::DEFAULT, size).map(|()| Code::OK))
}
