//! `hapflow_device_config`: which device, and how it is made.

use crate::caller::{Record, Text};
use crate::code::Failure;
use crate::config::check_head;
use crate::contract::as_in_header;
use crate::generated::HAPFLOW_KIND_DEVICE_CONFIG;
use crate::scene_source::SceneSource;
use hapflow_engine::{Scene, Value, settings};
use std::ffi::c_void;

/// `hapflow_device_config`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct DeviceConfig {
    kind: u32,
    size: u32,
    next: *const c_void,
    name: Text,
    scene: Text,
    toml: Text,
    toml_length: usize,
    settings: Text,
}

as_in_header!(
    DeviceConfig = hapflow_device_config { kind, size, next, name, scene, toml, toml_length, settings }
);

// SAFETY: repr(C), no padding with pointers of 4 or 8 bytes; every field takes any bits.
unsafe impl Record for DeviceConfig {
    const SIZE_AT: usize = 4;
    const FIRST_SIZE: usize = 8 + 6 * size_of::<usize>();
}

impl DeviceConfig {
    /// What the init function writes.
    pub const DEFAULT: Self = Self {
        kind: HAPFLOW_KIND_DEVICE_CONFIG,
        size: size_of::<Self>() as u32,
        next: std::ptr::null(),
        name: Text::NULL,
        scene: Text::NULL,
        toml: Text::NULL,
        toml_length: 0,
        settings: Text::NULL,
    };

    /// Refuses what this version does not know.
    pub fn check(&self) -> Result<(), Failure> {
        check_head(self.kind, HAPFLOW_KIND_DEVICE_CONFIG, self.next)
    }

    /// The scene that has the device, by its name if one is given.
    pub fn scene(&self) -> Result<Scene, Failure> {
        let Self { scene, toml, toml_length, settings, .. } = *self;
        let mut scene = SceneSource { scene, toml, toml_length, settings }.read(Some(Scene::default()))?;
        if !self.name.is_null() {
            let name = hapflow_devices::find(self.name.read()?)?.name;
            settings::set(&mut scene, "run.device", &Value::Text(name.into()))?;
        }
        scene.check()?;
        Ok(scene)
    }
}
