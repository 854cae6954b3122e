//! `hapflow_source_config`: a jet.

use crate::caller::{Out, Record, Text};
use crate::code::{Code, Failure};
use crate::config::check_head;
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use crate::part::{Part, flag, name, unreserved};
use crate::session::finite;
use glam::DVec3;
use hapflow_fluid::Source;
use std::ffi::c_void;

/// `hapflow_source_config`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SourceConfig {
    kind: u32,
    size: u32,
    next: *const c_void,
    name: Text,
    position: [f64; 3],
    direction: [f64; 3],
    diameter: f64,
    speed: f64,
    period: f64,
    duty: f64,
    on: u32,
    reserved: u32,
}

as_in_header!(
    SourceConfig = hapflow_source_config {
        kind,
        size,
        next,
        name,
        position,
        direction,
        diameter,
        speed,
        period,
        duty,
        on,
        reserved,
    }
);

// SAFETY: repr(C), no padding with pointers of 4 or 8 bytes; every field takes any bits.
unsafe impl Record for SourceConfig {
    const SIZE_AT: usize = 4;
    const FIRST_SIZE: usize = 96 + 2 * size_of::<usize>();
}

impl Part for SourceConfig {
    type Thing = Source;

    const DEFAULT: Self = Self {
        kind: c::HAPFLOW_KIND_SOURCE_CONFIG,
        size: size_of::<Self>() as u32,
        next: std::ptr::null(),
        name: Text::NULL,
        position: [0.0; 3],
        direction: [0.0, -1.0, 0.0],
        diameter: 0.02,
        speed: 1.0,
        period: 0.0,
        duty: 1.0,
        on: 1,
        reserved: 0,
    };

    fn thing(&self) -> Result<Source, Failure> {
        check_head(self.kind, c::HAPFLOW_KIND_SOURCE_CONFIG, self.next)?;
        unreserved(self.reserved)?;
        finite("position", &self.position)?;
        finite("direction", &self.direction)?;
        finite("diameter, speed, period, duty", &[self.diameter, self.speed, self.period, self.duty])?;
        Ok(Source {
            name: name(self.name)?,
            position: DVec3::from(self.position),
            direction: DVec3::from(self.direction),
            diameter: self.diameter,
            speed: self.speed,
            on: flag("on", self.on)?,
            period: self.period,
            duty: self.duty,
        })
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_source_config_init(config: Out<SourceConfig>, size: u32) -> Code {
    fence(|| config.init(&SourceConfig::DEFAULT, size).map(|()| Code::OK))
}
