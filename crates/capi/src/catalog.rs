//! `hapflow_scene_info` and `hapflow_device_info`: what the library brings along.

use crate::caller::{Out, Record, Shown, Text};
use crate::code::{Code, Failure};
use crate::contract::as_in_header;
use crate::fence::{fence, fence_main};
use crate::table::LIBRARY;
use hapflow_devices::DeviceInfo;

/// `hapflow_scene_info`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SceneRecord {
    size: u32,
    reserved: u32,
    name: Text,
    about: Text,
    toml: Text,
}

as_in_header!(SceneRecord = hapflow_scene_info { size, reserved, name, about, toml });

// SAFETY: repr(C), 8 bytes and three pointers of 4 or 8 bytes: no padding; every field takes any bits.
unsafe impl Record for SceneRecord {
    const SIZE_AT: usize = 0;
    const FIRST_SIZE: usize = 8 + 3 * size_of::<usize>();
}

impl SceneRecord {
    /// What the init function writes.
    const EMPTY: Self = Self {
        size: size_of::<Self>() as u32,
        reserved: 0,
        name: Text::EMPTY,
        about: Text::EMPTY,
        toml: Text::EMPTY,
    };
}

/// `hapflow_device_info`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct DeviceRecord {
    size: u32,
    sensed_dof: u32,
    driven_dof: u32,
    hardware: u32,
    max_force: f64,
    name: Text,
    about: Text,
}

as_in_header!(
    DeviceRecord = hapflow_device_info { size, sensed_dof, driven_dof, hardware, max_force, name, about }
);

// SAFETY: repr(C), 16 bytes, an f64 and two pointers of 4 or 8 bytes: no padding; every field takes any bits.
unsafe impl Record for DeviceRecord {
    const SIZE_AT: usize = 0;
    const FIRST_SIZE: usize = 24 + 2 * size_of::<usize>();
}

impl DeviceRecord {
    /// What the init function writes.
    const EMPTY: Self = Self {
        size: size_of::<Self>() as u32,
        sensed_dof: 0,
        driven_dof: 0,
        hardware: 0,
        max_force: 0.0,
        name: Text::EMPTY,
        about: Text::EMPTY,
    };
}

/// A shipped scene's texts.
struct SceneTexts {
    name: Shown,
    about: Shown,
    toml: Shown,
}

impl SceneTexts {
    fn new(name: &str, toml: &str) -> Self {
        let about = hapflow_engine::parse(toml, name).map(|scene| scene.about).unwrap_or_default();
        Self { name: Shown::new(name), about: Shown::new(&about), toml: Shown::new(toml) }
    }

    fn record(&self) -> SceneRecord {
        let (name, about, toml) = (self.name.text(), self.about.text(), self.toml.text());
        SceneRecord { name, about, toml, ..SceneRecord::EMPTY }
    }
}

/// A device, and its texts.
struct DeviceTexts {
    device: DeviceInfo,
    name: Shown,
    about: Shown,
}

impl DeviceTexts {
    fn new(device: DeviceInfo) -> Self {
        Self { device, name: Shown::new(device.name), about: Shown::new(device.about) }
    }

    fn record(&self) -> DeviceRecord {
        DeviceRecord {
            sensed_dof: self.device.sensed_dof.into(),
            driven_dof: self.device.driven_dof.into(),
            hardware: self.device.hardware.into(),
            max_force: self.device.max_force_n,
            name: self.name.text(),
            about: self.about.text(),
            ..DeviceRecord::EMPTY
        }
    }
}

/// The shipped scenes and the devices, as texts that C may look at for as long as the process lasts.
pub struct Catalog {
    scenes: Vec<SceneTexts>,
    devices: Vec<DeviceTexts>,
}

impl Catalog {
    pub fn new() -> Self {
        let scenes = hapflow_engine::shipped().iter().map(|(name, toml)| SceneTexts::new(name, toml));
        let devices = hapflow_devices::list().into_iter().map(DeviceTexts::new);
        Self { scenes: scenes.collect(), devices: devices.collect() }
    }
}

/// The element `index` of `all`.
fn nth<'a, T>(all: &'a [T], index: u32, what: &str) -> Result<&'a T, Failure> {
    let found = usize::try_from(index).ok().and_then(|i| all.get(i));
    found.ok_or_else(|| Failure::index(what, index, count(all)))
}

fn count<T>(all: &[T]) -> u32 {
    u32::try_from(all.len()).unwrap_or(u32::MAX)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_info_init(info: Out<SceneRecord>, size: u32) -> Code {
    fence(|| info.init(&SceneRecord::EMPTY, size).map(|()| Code::OK))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_count() -> u32 {
    count(hapflow_engine::shipped())
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_get(index: u32, info: Out<SceneRecord>) -> Code {
    fence_main(|| {
        info.check_record()?;
        info.fill(&nth(&LIBRARY.catalog().scenes, index, "scene")?.record())?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_info_init(info: Out<DeviceRecord>, size: u32) -> Code {
    fence(|| info.init(&DeviceRecord::EMPTY, size).map(|()| Code::OK))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_count() -> u32 {
    count(&hapflow_devices::list())
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_get(index: u32, info: Out<DeviceRecord>) -> Code {
    fence_main(|| {
        info.check_record()?;
        info.fill(&nth(&LIBRARY.catalog().devices, index, "device")?.record())?;
        Ok(Code::OK)
    })
}
