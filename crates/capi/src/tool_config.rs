//! `hapflow_tool_config`: a tool in a hand.

use crate::caller::{Out, Record, Text};
use crate::code::{Code, Failure};
use crate::config::check_head;
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use crate::part::{Part, form_of, name, null, unreserved};
use crate::session::finite;
use glam::DVec3;
use hapflow_engine::ToolSettings;
use hapflow_haptics::SolidFeel;
use std::ffi::c_void;

/// `hapflow_tool_config`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct ToolConfig {
    kind: u32,
    size: u32,
    next: *const c_void,
    name: Text,
    shape: u32,
    reserved: u32,
    radius: f64,
    thickness: f64,
    mass: f64,
    collision_response: f64,
    position: [f64; 3],
    force_scale: f64,
    solid_stiffness: f64,
    solid_damping: f64,
    length: f64,
    extent: [f64; 3],
    scale: f64,
    file: Text,
    mesh: *const c_void,
    buoyancy_scale: f64,
}

as_in_header!(
    ToolConfig = hapflow_tool_config {
        kind,
        size,
        next,
        name,
        shape,
        reserved,
        radius,
        thickness,
        mass,
        collision_response,
        position,
        force_scale,
        solid_stiffness,
        solid_damping,
        length,
        extent,
        scale,
        file,
        mesh,
        buoyancy_scale,
    }
);

// SAFETY: repr(C), no padding with pointers of 4 or 8 bytes; every field takes any bits.
unsafe impl Record for ToolConfig {
    const SIZE_AT: usize = 4;
    const FIRST_SIZE: usize = 96 + 2 * size_of::<usize>();
}

impl Part for ToolConfig {
    type Thing = ToolSettings;

    const DEFAULT: Self = Self {
        kind: c::HAPFLOW_KIND_TOOL_CONFIG,
        size: size_of::<Self>() as u32,
        next: std::ptr::null(),
        name: Text::NULL,
        shape: c::HAPFLOW_SHAPE_SPHERE,
        reserved: 0,
        radius: 0.015,
        thickness: 0.01,
        mass: 0.1,
        collision_response: 0.2,
        position: [0.0; 3],
        force_scale: 1.0,
        solid_stiffness: 0.0,
        solid_damping: 0.0,
        length: 0.04,
        extent: [0.03; 3],
        scale: 1.0,
        file: Text::NULL,
        mesh: std::ptr::null(),
        buoyancy_scale: 1.0,
    };

    fn thing(&self) -> Result<ToolSettings, Failure> {
        check_head(self.kind, c::HAPFLOW_KIND_TOOL_CONFIG, self.next)?;
        unreserved(self.reserved)?;
        null(self.mesh)?;
        finite("mass", &[self.mass])?;
        finite("position", &self.position)?;
        finite("collision_response, force_scale", &[self.collision_response, self.force_scale])?;
        finite("buoyancy_scale", &[self.buoyancy_scale])?;
        finite("solid_stiffness, solid_damping", &[self.solid_stiffness, self.solid_damping])?;
        Ok(ToolSettings {
            name: name(self.name)?,
            form: form_of!(self)?,
            mass: self.mass,
            collision_response: self.collision_response,
            position: DVec3::from(self.position),
            force_scale: self.force_scale,
            buoyancy_scale: self.buoyancy_scale,
            solids: SolidFeel {
                stiffness_n_per_m: self.solid_stiffness,
                damping_n_s_per_m: self.solid_damping,
            },
        })
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_tool_config_init(config: Out<ToolConfig>, size: u32) -> Code {
    fence(|| config.init(&ToolConfig::DEFAULT, size).map(|()| Code::OK))
}
