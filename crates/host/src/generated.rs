//! The header in Rust, by tools/bindings.sh: not to be edited.
#![allow(dead_code, missing_docs, non_camel_case_types, unsafe_op_in_unsafe_fn, clippy::all)]
#![allow(clippy::undocumented_unsafe_blocks, clippy::missing_safety_doc)]

pub const HAPFLOW_ABI_VERSION: u32 = 1;
pub const HAPFLOW_MAX_SCENES: u32 = 64;
pub const HAPFLOW_KIND_SOURCE_CONFIG: u32 = 3;
pub const HAPFLOW_KIND_OBSTACLE_CONFIG: u32 = 4;
pub const HAPFLOW_KIND_TOOL_CONFIG: u32 = 5;
pub const HAPFLOW_KIND_BODY_CONFIG: u32 = 6;
pub const HAPFLOW_MAX_DEVICES: u32 = 64;
pub const HAPFLOW_KIND_DEVICE_CONFIG: u32 = 2;
pub const HAPFLOW_MAX_SESSIONS: u32 = 64;
pub const HAPFLOW_KIND_SESSION_CONFIG: u32 = 1;
pub const HAPFLOW_MAX_TOOLS: u32 = 8;
pub const HAPFLOW_EXTENSION_DEVICE: &[u8; 17] = b"hapflow.device/1\0";
pub const HAPFLOW_EXTENSION_LOG: &[u8; 14] = b"hapflow.log/1\0";
pub const HAPFLOW_EXTENSION_FLUID_BACKEND: &[u8; 24] = b"hapflow.fluid-backend/1\0";
pub const HAPFLOW_EXTENSION_COUPLING: &[u8; 19] = b"hapflow.coupling/1\0";
pub const HAPFLOW_MAX_CONTACTS: u32 = 8;
pub type hapflow_result = i32;
pub const HAPFLOW_OK: _bindgen_ty_1 = 0;
pub const HAPFLOW_REMARK_FORCE_HELD: _bindgen_ty_1 = 1;
pub const HAPFLOW_REMARK_NO_TIME: _bindgen_ty_1 = 2;
pub const HAPFLOW_REMARK_LATE: _bindgen_ty_1 = 3;
pub const HAPFLOW_REMARK_MORE: _bindgen_ty_1 = 4;
pub const HAPFLOW_ERROR_PANIC: _bindgen_ty_1 = -1;
pub const HAPFLOW_ERROR_NOT_NEGOTIATED: _bindgen_ty_1 = -2;
pub const HAPFLOW_ERROR_VERSION: _bindgen_ty_1 = -3;
pub const HAPFLOW_ERROR_NULL: _bindgen_ty_1 = -4;
pub const HAPFLOW_ERROR_HANDLE: _bindgen_ty_1 = -5;
pub const HAPFLOW_ERROR_BUSY: _bindgen_ty_1 = -6;
pub const HAPFLOW_ERROR_FULL: _bindgen_ty_1 = -7;
pub const HAPFLOW_ERROR_STRUCT: _bindgen_ty_1 = -8;
pub const HAPFLOW_ERROR_UNSUPPORTED: _bindgen_ty_1 = -9;
pub const HAPFLOW_ERROR_TEXT: _bindgen_ty_1 = -10;
pub const HAPFLOW_ERROR_SCENE: _bindgen_ty_1 = -11;
pub const HAPFLOW_ERROR_NOT_FOUND: _bindgen_ty_1 = -12;
pub const HAPFLOW_ERROR_SETTING: _bindgen_ty_1 = -13;
pub const HAPFLOW_ERROR_VALUE: _bindgen_ty_1 = -14;
pub const HAPFLOW_ERROR_FIXED: _bindgen_ty_1 = -15;
pub const HAPFLOW_ERROR_NOT_FINITE: _bindgen_ty_1 = -16;
pub const HAPFLOW_ERROR_ORIENTATION: _bindgen_ty_1 = -17;
pub const HAPFLOW_ERROR_TIME: _bindgen_ty_1 = -18;
pub const HAPFLOW_ERROR_FAULTED: _bindgen_ty_1 = -19;
pub const HAPFLOW_ERROR_INDEX: _bindgen_ty_1 = -20;
pub const HAPFLOW_ERROR_DRIVE: _bindgen_ty_1 = -21;
pub const HAPFLOW_ERROR_DEVICE: _bindgen_ty_1 = -22;
pub const HAPFLOW_ERROR_FILE: _bindgen_ty_1 = -23;
pub const HAPFLOW_ERROR_RECORDING: _bindgen_ty_1 = -24;
pub type _bindgen_ty_1 = ::core::ffi::c_int;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_scene_info {
    pub size: u32,
    pub reserved: u32,
    pub name: *const ::core::ffi::c_char,
    pub about: *const ::core::ffi::c_char,
    pub toml: *const ::core::ffi::c_char,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_scene_info",
    ][::core::mem::size_of::<hapflow_scene_info>() - 32usize];
    [
        "Alignment of hapflow_scene_info",
    ][::core::mem::align_of::<hapflow_scene_info>() - 8usize];
    [
        "Offset of field: hapflow_scene_info::size",
    ][::core::mem::offset_of!(hapflow_scene_info, size) - 0usize];
    [
        "Offset of field: hapflow_scene_info::reserved",
    ][::core::mem::offset_of!(hapflow_scene_info, reserved) - 4usize];
    [
        "Offset of field: hapflow_scene_info::name",
    ][::core::mem::offset_of!(hapflow_scene_info, name) - 8usize];
    [
        "Offset of field: hapflow_scene_info::about",
    ][::core::mem::offset_of!(hapflow_scene_info, about) - 16usize];
    [
        "Offset of field: hapflow_scene_info::toml",
    ][::core::mem::offset_of!(hapflow_scene_info, toml) - 24usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_scene {
    pub id: u64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of hapflow_scene"][::core::mem::size_of::<hapflow_scene>() - 8usize];
    ["Alignment of hapflow_scene"][::core::mem::align_of::<hapflow_scene>() - 8usize];
    [
        "Offset of field: hapflow_scene::id",
    ][::core::mem::offset_of!(hapflow_scene, id) - 0usize];
};
pub const HAPFLOW_AXIS_X: _bindgen_ty_2 = 1;
pub const HAPFLOW_AXIS_Y: _bindgen_ty_2 = 2;
pub const HAPFLOW_AXIS_Z: _bindgen_ty_2 = 4;
pub type _bindgen_ty_2 = ::core::ffi::c_uint;
pub const HAPFLOW_SHAPE_SPHERE: _bindgen_ty_3 = 1;
pub const HAPFLOW_SHAPE_DISC: _bindgen_ty_3 = 2;
pub const HAPFLOW_SHAPE_CYLINDER: _bindgen_ty_3 = 3;
pub const HAPFLOW_SHAPE_CAPSULE: _bindgen_ty_3 = 4;
pub const HAPFLOW_SHAPE_BOX: _bindgen_ty_3 = 5;
pub const HAPFLOW_SHAPE_MESH: _bindgen_ty_3 = 6;
pub type _bindgen_ty_3 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_source_config {
    pub kind: u32,
    pub size: u32,
    pub next: *const ::core::ffi::c_void,
    pub name: *const ::core::ffi::c_char,
    pub position: [f64; 3usize],
    pub direction: [f64; 3usize],
    pub diameter: f64,
    pub speed: f64,
    pub period: f64,
    pub duty: f64,
    pub on: u32,
    pub reserved: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_source_config",
    ][::core::mem::size_of::<hapflow_source_config>() - 112usize];
    [
        "Alignment of hapflow_source_config",
    ][::core::mem::align_of::<hapflow_source_config>() - 8usize];
    [
        "Offset of field: hapflow_source_config::kind",
    ][::core::mem::offset_of!(hapflow_source_config, kind) - 0usize];
    [
        "Offset of field: hapflow_source_config::size",
    ][::core::mem::offset_of!(hapflow_source_config, size) - 4usize];
    [
        "Offset of field: hapflow_source_config::next",
    ][::core::mem::offset_of!(hapflow_source_config, next) - 8usize];
    [
        "Offset of field: hapflow_source_config::name",
    ][::core::mem::offset_of!(hapflow_source_config, name) - 16usize];
    [
        "Offset of field: hapflow_source_config::position",
    ][::core::mem::offset_of!(hapflow_source_config, position) - 24usize];
    [
        "Offset of field: hapflow_source_config::direction",
    ][::core::mem::offset_of!(hapflow_source_config, direction) - 48usize];
    [
        "Offset of field: hapflow_source_config::diameter",
    ][::core::mem::offset_of!(hapflow_source_config, diameter) - 72usize];
    [
        "Offset of field: hapflow_source_config::speed",
    ][::core::mem::offset_of!(hapflow_source_config, speed) - 80usize];
    [
        "Offset of field: hapflow_source_config::period",
    ][::core::mem::offset_of!(hapflow_source_config, period) - 88usize];
    [
        "Offset of field: hapflow_source_config::duty",
    ][::core::mem::offset_of!(hapflow_source_config, duty) - 96usize];
    [
        "Offset of field: hapflow_source_config::on",
    ][::core::mem::offset_of!(hapflow_source_config, on) - 104usize];
    [
        "Offset of field: hapflow_source_config::reserved",
    ][::core::mem::offset_of!(hapflow_source_config, reserved) - 108usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_obstacle_config {
    pub kind: u32,
    pub size: u32,
    pub next: *const ::core::ffi::c_void,
    pub name: *const ::core::ffi::c_char,
    pub shape: u32,
    pub reserved: u32,
    pub radius: f64,
    pub thickness: f64,
    pub position: [f64; 3usize],
    pub length: f64,
    pub extent: [f64; 3usize],
    pub scale: f64,
    pub file: *const ::core::ffi::c_char,
    pub mesh: *const ::core::ffi::c_void,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_obstacle_config",
    ][::core::mem::size_of::<hapflow_obstacle_config>() - 128usize];
    [
        "Alignment of hapflow_obstacle_config",
    ][::core::mem::align_of::<hapflow_obstacle_config>() - 8usize];
    [
        "Offset of field: hapflow_obstacle_config::kind",
    ][::core::mem::offset_of!(hapflow_obstacle_config, kind) - 0usize];
    [
        "Offset of field: hapflow_obstacle_config::size",
    ][::core::mem::offset_of!(hapflow_obstacle_config, size) - 4usize];
    [
        "Offset of field: hapflow_obstacle_config::next",
    ][::core::mem::offset_of!(hapflow_obstacle_config, next) - 8usize];
    [
        "Offset of field: hapflow_obstacle_config::name",
    ][::core::mem::offset_of!(hapflow_obstacle_config, name) - 16usize];
    [
        "Offset of field: hapflow_obstacle_config::shape",
    ][::core::mem::offset_of!(hapflow_obstacle_config, shape) - 24usize];
    [
        "Offset of field: hapflow_obstacle_config::reserved",
    ][::core::mem::offset_of!(hapflow_obstacle_config, reserved) - 28usize];
    [
        "Offset of field: hapflow_obstacle_config::radius",
    ][::core::mem::offset_of!(hapflow_obstacle_config, radius) - 32usize];
    [
        "Offset of field: hapflow_obstacle_config::thickness",
    ][::core::mem::offset_of!(hapflow_obstacle_config, thickness) - 40usize];
    [
        "Offset of field: hapflow_obstacle_config::position",
    ][::core::mem::offset_of!(hapflow_obstacle_config, position) - 48usize];
    [
        "Offset of field: hapflow_obstacle_config::length",
    ][::core::mem::offset_of!(hapflow_obstacle_config, length) - 72usize];
    [
        "Offset of field: hapflow_obstacle_config::extent",
    ][::core::mem::offset_of!(hapflow_obstacle_config, extent) - 80usize];
    [
        "Offset of field: hapflow_obstacle_config::scale",
    ][::core::mem::offset_of!(hapflow_obstacle_config, scale) - 104usize];
    [
        "Offset of field: hapflow_obstacle_config::file",
    ][::core::mem::offset_of!(hapflow_obstacle_config, file) - 112usize];
    [
        "Offset of field: hapflow_obstacle_config::mesh",
    ][::core::mem::offset_of!(hapflow_obstacle_config, mesh) - 120usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_tool_config {
    pub kind: u32,
    pub size: u32,
    pub next: *const ::core::ffi::c_void,
    pub name: *const ::core::ffi::c_char,
    pub shape: u32,
    pub reserved: u32,
    pub radius: f64,
    pub thickness: f64,
    pub mass: f64,
    pub collision_response: f64,
    pub position: [f64; 3usize],
    pub force_scale: f64,
    pub solid_stiffness: f64,
    pub solid_damping: f64,
    pub length: f64,
    pub extent: [f64; 3usize],
    pub scale: f64,
    pub file: *const ::core::ffi::c_char,
    pub mesh: *const ::core::ffi::c_void,
    pub buoyancy_scale: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_tool_config",
    ][::core::mem::size_of::<hapflow_tool_config>() - 176usize];
    [
        "Alignment of hapflow_tool_config",
    ][::core::mem::align_of::<hapflow_tool_config>() - 8usize];
    [
        "Offset of field: hapflow_tool_config::kind",
    ][::core::mem::offset_of!(hapflow_tool_config, kind) - 0usize];
    [
        "Offset of field: hapflow_tool_config::size",
    ][::core::mem::offset_of!(hapflow_tool_config, size) - 4usize];
    [
        "Offset of field: hapflow_tool_config::next",
    ][::core::mem::offset_of!(hapflow_tool_config, next) - 8usize];
    [
        "Offset of field: hapflow_tool_config::name",
    ][::core::mem::offset_of!(hapflow_tool_config, name) - 16usize];
    [
        "Offset of field: hapflow_tool_config::shape",
    ][::core::mem::offset_of!(hapflow_tool_config, shape) - 24usize];
    [
        "Offset of field: hapflow_tool_config::reserved",
    ][::core::mem::offset_of!(hapflow_tool_config, reserved) - 28usize];
    [
        "Offset of field: hapflow_tool_config::radius",
    ][::core::mem::offset_of!(hapflow_tool_config, radius) - 32usize];
    [
        "Offset of field: hapflow_tool_config::thickness",
    ][::core::mem::offset_of!(hapflow_tool_config, thickness) - 40usize];
    [
        "Offset of field: hapflow_tool_config::mass",
    ][::core::mem::offset_of!(hapflow_tool_config, mass) - 48usize];
    [
        "Offset of field: hapflow_tool_config::collision_response",
    ][::core::mem::offset_of!(hapflow_tool_config, collision_response) - 56usize];
    [
        "Offset of field: hapflow_tool_config::position",
    ][::core::mem::offset_of!(hapflow_tool_config, position) - 64usize];
    [
        "Offset of field: hapflow_tool_config::force_scale",
    ][::core::mem::offset_of!(hapflow_tool_config, force_scale) - 88usize];
    [
        "Offset of field: hapflow_tool_config::solid_stiffness",
    ][::core::mem::offset_of!(hapflow_tool_config, solid_stiffness) - 96usize];
    [
        "Offset of field: hapflow_tool_config::solid_damping",
    ][::core::mem::offset_of!(hapflow_tool_config, solid_damping) - 104usize];
    [
        "Offset of field: hapflow_tool_config::length",
    ][::core::mem::offset_of!(hapflow_tool_config, length) - 112usize];
    [
        "Offset of field: hapflow_tool_config::extent",
    ][::core::mem::offset_of!(hapflow_tool_config, extent) - 120usize];
    [
        "Offset of field: hapflow_tool_config::scale",
    ][::core::mem::offset_of!(hapflow_tool_config, scale) - 144usize];
    [
        "Offset of field: hapflow_tool_config::file",
    ][::core::mem::offset_of!(hapflow_tool_config, file) - 152usize];
    [
        "Offset of field: hapflow_tool_config::mesh",
    ][::core::mem::offset_of!(hapflow_tool_config, mesh) - 160usize];
    [
        "Offset of field: hapflow_tool_config::buoyancy_scale",
    ][::core::mem::offset_of!(hapflow_tool_config, buoyancy_scale) - 168usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_body_config {
    pub kind: u32,
    pub size: u32,
    pub next: *const ::core::ffi::c_void,
    pub name: *const ::core::ffi::c_char,
    pub shape: u32,
    pub reserved: u32,
    pub radius: f64,
    pub thickness: f64,
    pub density: f64,
    pub position: [f64; 3usize],
    pub length: f64,
    pub extent: [f64; 3usize],
    pub scale: f64,
    pub file: *const ::core::ffi::c_char,
    pub mesh: *const ::core::ffi::c_void,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_body_config",
    ][::core::mem::size_of::<hapflow_body_config>() - 136usize];
    [
        "Alignment of hapflow_body_config",
    ][::core::mem::align_of::<hapflow_body_config>() - 8usize];
    [
        "Offset of field: hapflow_body_config::kind",
    ][::core::mem::offset_of!(hapflow_body_config, kind) - 0usize];
    [
        "Offset of field: hapflow_body_config::size",
    ][::core::mem::offset_of!(hapflow_body_config, size) - 4usize];
    [
        "Offset of field: hapflow_body_config::next",
    ][::core::mem::offset_of!(hapflow_body_config, next) - 8usize];
    [
        "Offset of field: hapflow_body_config::name",
    ][::core::mem::offset_of!(hapflow_body_config, name) - 16usize];
    [
        "Offset of field: hapflow_body_config::shape",
    ][::core::mem::offset_of!(hapflow_body_config, shape) - 24usize];
    [
        "Offset of field: hapflow_body_config::reserved",
    ][::core::mem::offset_of!(hapflow_body_config, reserved) - 28usize];
    [
        "Offset of field: hapflow_body_config::radius",
    ][::core::mem::offset_of!(hapflow_body_config, radius) - 32usize];
    [
        "Offset of field: hapflow_body_config::thickness",
    ][::core::mem::offset_of!(hapflow_body_config, thickness) - 40usize];
    [
        "Offset of field: hapflow_body_config::density",
    ][::core::mem::offset_of!(hapflow_body_config, density) - 48usize];
    [
        "Offset of field: hapflow_body_config::position",
    ][::core::mem::offset_of!(hapflow_body_config, position) - 56usize];
    [
        "Offset of field: hapflow_body_config::length",
    ][::core::mem::offset_of!(hapflow_body_config, length) - 80usize];
    [
        "Offset of field: hapflow_body_config::extent",
    ][::core::mem::offset_of!(hapflow_body_config, extent) - 88usize];
    [
        "Offset of field: hapflow_body_config::scale",
    ][::core::mem::offset_of!(hapflow_body_config, scale) - 112usize];
    [
        "Offset of field: hapflow_body_config::file",
    ][::core::mem::offset_of!(hapflow_body_config, file) - 120usize];
    [
        "Offset of field: hapflow_body_config::mesh",
    ][::core::mem::offset_of!(hapflow_body_config, mesh) - 128usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_tool_state {
    pub size: u32,
    pub tool: u32,
    pub buttons: u32,
    pub reserved: u32,
    pub time_s: f64,
    pub dt_s: f64,
    pub position: [f64; 3usize],
    pub orientation: [f64; 4usize],
    pub velocity: [f64; 3usize],
    pub angular_velocity: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_tool_state",
    ][::core::mem::size_of::<hapflow_tool_state>() - 136usize];
    [
        "Alignment of hapflow_tool_state",
    ][::core::mem::align_of::<hapflow_tool_state>() - 8usize];
    [
        "Offset of field: hapflow_tool_state::size",
    ][::core::mem::offset_of!(hapflow_tool_state, size) - 0usize];
    [
        "Offset of field: hapflow_tool_state::tool",
    ][::core::mem::offset_of!(hapflow_tool_state, tool) - 4usize];
    [
        "Offset of field: hapflow_tool_state::buttons",
    ][::core::mem::offset_of!(hapflow_tool_state, buttons) - 8usize];
    [
        "Offset of field: hapflow_tool_state::reserved",
    ][::core::mem::offset_of!(hapflow_tool_state, reserved) - 12usize];
    [
        "Offset of field: hapflow_tool_state::time_s",
    ][::core::mem::offset_of!(hapflow_tool_state, time_s) - 16usize];
    [
        "Offset of field: hapflow_tool_state::dt_s",
    ][::core::mem::offset_of!(hapflow_tool_state, dt_s) - 24usize];
    [
        "Offset of field: hapflow_tool_state::position",
    ][::core::mem::offset_of!(hapflow_tool_state, position) - 32usize];
    [
        "Offset of field: hapflow_tool_state::orientation",
    ][::core::mem::offset_of!(hapflow_tool_state, orientation) - 56usize];
    [
        "Offset of field: hapflow_tool_state::velocity",
    ][::core::mem::offset_of!(hapflow_tool_state, velocity) - 88usize];
    [
        "Offset of field: hapflow_tool_state::angular_velocity",
    ][::core::mem::offset_of!(hapflow_tool_state, angular_velocity) - 112usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_wrench {
    pub force: [f64; 3usize],
    pub torque: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of hapflow_wrench"][::core::mem::size_of::<hapflow_wrench>() - 48usize];
    ["Alignment of hapflow_wrench"][::core::mem::align_of::<hapflow_wrench>() - 8usize];
    [
        "Offset of field: hapflow_wrench::force",
    ][::core::mem::offset_of!(hapflow_wrench, force) - 0usize];
    [
        "Offset of field: hapflow_wrench::torque",
    ][::core::mem::offset_of!(hapflow_wrench, torque) - 24usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_device_info {
    pub size: u32,
    pub sensed_dof: u32,
    pub driven_dof: u32,
    pub hardware: u32,
    pub max_force: f64,
    pub name: *const ::core::ffi::c_char,
    pub about: *const ::core::ffi::c_char,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_device_info",
    ][::core::mem::size_of::<hapflow_device_info>() - 40usize];
    [
        "Alignment of hapflow_device_info",
    ][::core::mem::align_of::<hapflow_device_info>() - 8usize];
    [
        "Offset of field: hapflow_device_info::size",
    ][::core::mem::offset_of!(hapflow_device_info, size) - 0usize];
    [
        "Offset of field: hapflow_device_info::sensed_dof",
    ][::core::mem::offset_of!(hapflow_device_info, sensed_dof) - 4usize];
    [
        "Offset of field: hapflow_device_info::driven_dof",
    ][::core::mem::offset_of!(hapflow_device_info, driven_dof) - 8usize];
    [
        "Offset of field: hapflow_device_info::hardware",
    ][::core::mem::offset_of!(hapflow_device_info, hardware) - 12usize];
    [
        "Offset of field: hapflow_device_info::max_force",
    ][::core::mem::offset_of!(hapflow_device_info, max_force) - 16usize];
    [
        "Offset of field: hapflow_device_info::name",
    ][::core::mem::offset_of!(hapflow_device_info, name) - 24usize];
    [
        "Offset of field: hapflow_device_info::about",
    ][::core::mem::offset_of!(hapflow_device_info, about) - 32usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_device {
    pub id: u64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of hapflow_device"][::core::mem::size_of::<hapflow_device>() - 8usize];
    ["Alignment of hapflow_device"][::core::mem::align_of::<hapflow_device>() - 8usize];
    [
        "Offset of field: hapflow_device::id",
    ][::core::mem::offset_of!(hapflow_device, id) - 0usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_device_config {
    pub kind: u32,
    pub size: u32,
    pub next: *const ::core::ffi::c_void,
    pub name: *const ::core::ffi::c_char,
    pub scene: *const ::core::ffi::c_char,
    pub toml: *const ::core::ffi::c_char,
    pub toml_length: usize,
    pub settings: *const ::core::ffi::c_char,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_device_config",
    ][::core::mem::size_of::<hapflow_device_config>() - 56usize];
    [
        "Alignment of hapflow_device_config",
    ][::core::mem::align_of::<hapflow_device_config>() - 8usize];
    [
        "Offset of field: hapflow_device_config::kind",
    ][::core::mem::offset_of!(hapflow_device_config, kind) - 0usize];
    [
        "Offset of field: hapflow_device_config::size",
    ][::core::mem::offset_of!(hapflow_device_config, size) - 4usize];
    [
        "Offset of field: hapflow_device_config::next",
    ][::core::mem::offset_of!(hapflow_device_config, next) - 8usize];
    [
        "Offset of field: hapflow_device_config::name",
    ][::core::mem::offset_of!(hapflow_device_config, name) - 16usize];
    [
        "Offset of field: hapflow_device_config::scene",
    ][::core::mem::offset_of!(hapflow_device_config, scene) - 24usize];
    [
        "Offset of field: hapflow_device_config::toml",
    ][::core::mem::offset_of!(hapflow_device_config, toml) - 32usize];
    [
        "Offset of field: hapflow_device_config::toml_length",
    ][::core::mem::offset_of!(hapflow_device_config, toml_length) - 40usize];
    [
        "Offset of field: hapflow_device_config::settings",
    ][::core::mem::offset_of!(hapflow_device_config, settings) - 48usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_session {
    pub id: u64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of hapflow_session"][::core::mem::size_of::<hapflow_session>() - 8usize];
    [
        "Alignment of hapflow_session",
    ][::core::mem::align_of::<hapflow_session>() - 8usize];
    [
        "Offset of field: hapflow_session::id",
    ][::core::mem::offset_of!(hapflow_session, id) - 0usize];
};
pub const HAPFLOW_DRIVE_HOST: _bindgen_ty_4 = 0;
pub const HAPFLOW_DRIVE_OWNED: _bindgen_ty_4 = 1;
pub type _bindgen_ty_4 = ::core::ffi::c_uint;
pub const HAPFLOW_LOG_ERROR: _bindgen_ty_5 = 1;
pub const HAPFLOW_LOG_WARNING: _bindgen_ty_5 = 2;
pub const HAPFLOW_LOG_INFO: _bindgen_ty_5 = 3;
pub type _bindgen_ty_5 = ::core::ffi::c_uint;
pub type hapflow_log_function = ::core::option::Option<
    unsafe extern "C" fn(
        level: u32,
        text: *const ::core::ffi::c_char,
        user: *mut ::core::ffi::c_void,
    ),
>;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_session_config {
    pub kind: u32,
    pub size: u32,
    pub next: *const ::core::ffi::c_void,
    pub scene: *const ::core::ffi::c_char,
    pub toml: *const ::core::ffi::c_char,
    pub toml_length: usize,
    pub settings: *const ::core::ffi::c_char,
    pub threads: u32,
    pub fluid_drive: u32,
    pub servo_drive: u32,
    pub device_count: u32,
    pub devices: *const hapflow_device,
    pub log: hapflow_log_function,
    pub log_user: *mut ::core::ffi::c_void,
    pub record: u32,
    pub reserved: u32,
    pub built: hapflow_scene,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_session_config",
    ][::core::mem::size_of::<hapflow_session_config>() - 104usize];
    [
        "Alignment of hapflow_session_config",
    ][::core::mem::align_of::<hapflow_session_config>() - 8usize];
    [
        "Offset of field: hapflow_session_config::kind",
    ][::core::mem::offset_of!(hapflow_session_config, kind) - 0usize];
    [
        "Offset of field: hapflow_session_config::size",
    ][::core::mem::offset_of!(hapflow_session_config, size) - 4usize];
    [
        "Offset of field: hapflow_session_config::next",
    ][::core::mem::offset_of!(hapflow_session_config, next) - 8usize];
    [
        "Offset of field: hapflow_session_config::scene",
    ][::core::mem::offset_of!(hapflow_session_config, scene) - 16usize];
    [
        "Offset of field: hapflow_session_config::toml",
    ][::core::mem::offset_of!(hapflow_session_config, toml) - 24usize];
    [
        "Offset of field: hapflow_session_config::toml_length",
    ][::core::mem::offset_of!(hapflow_session_config, toml_length) - 32usize];
    [
        "Offset of field: hapflow_session_config::settings",
    ][::core::mem::offset_of!(hapflow_session_config, settings) - 40usize];
    [
        "Offset of field: hapflow_session_config::threads",
    ][::core::mem::offset_of!(hapflow_session_config, threads) - 48usize];
    [
        "Offset of field: hapflow_session_config::fluid_drive",
    ][::core::mem::offset_of!(hapflow_session_config, fluid_drive) - 52usize];
    [
        "Offset of field: hapflow_session_config::servo_drive",
    ][::core::mem::offset_of!(hapflow_session_config, servo_drive) - 56usize];
    [
        "Offset of field: hapflow_session_config::device_count",
    ][::core::mem::offset_of!(hapflow_session_config, device_count) - 60usize];
    [
        "Offset of field: hapflow_session_config::devices",
    ][::core::mem::offset_of!(hapflow_session_config, devices) - 64usize];
    [
        "Offset of field: hapflow_session_config::log",
    ][::core::mem::offset_of!(hapflow_session_config, log) - 72usize];
    [
        "Offset of field: hapflow_session_config::log_user",
    ][::core::mem::offset_of!(hapflow_session_config, log_user) - 80usize];
    [
        "Offset of field: hapflow_session_config::record",
    ][::core::mem::offset_of!(hapflow_session_config, record) - 88usize];
    [
        "Offset of field: hapflow_session_config::reserved",
    ][::core::mem::offset_of!(hapflow_session_config, reserved) - 92usize];
    [
        "Offset of field: hapflow_session_config::built",
    ][::core::mem::offset_of!(hapflow_session_config, built) - 96usize];
};
pub const HAPFLOW_SETTING_NUMBER: _bindgen_ty_6 = 1;
pub const HAPFLOW_SETTING_INTEGER: _bindgen_ty_6 = 2;
pub const HAPFLOW_SETTING_SWITCH: _bindgen_ty_6 = 3;
pub const HAPFLOW_SETTING_CHOICE: _bindgen_ty_6 = 4;
pub const HAPFLOW_SETTING_TEXT: _bindgen_ty_6 = 5;
pub const HAPFLOW_SETTING_VECTOR: _bindgen_ty_6 = 6;
pub type _bindgen_ty_6 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_setting_info {
    pub size: u32,
    pub kind: u32,
    pub live: u32,
    pub reserved: u32,
    pub min: f64,
    pub max: f64,
    pub path: *const ::core::ffi::c_char,
    pub group: *const ::core::ffi::c_char,
    pub unit: *const ::core::ffi::c_char,
    pub about: *const ::core::ffi::c_char,
    pub choices: *const ::core::ffi::c_char,
    pub usual: *const ::core::ffi::c_char,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_setting_info",
    ][::core::mem::size_of::<hapflow_setting_info>() - 80usize];
    [
        "Alignment of hapflow_setting_info",
    ][::core::mem::align_of::<hapflow_setting_info>() - 8usize];
    [
        "Offset of field: hapflow_setting_info::size",
    ][::core::mem::offset_of!(hapflow_setting_info, size) - 0usize];
    [
        "Offset of field: hapflow_setting_info::kind",
    ][::core::mem::offset_of!(hapflow_setting_info, kind) - 4usize];
    [
        "Offset of field: hapflow_setting_info::live",
    ][::core::mem::offset_of!(hapflow_setting_info, live) - 8usize];
    [
        "Offset of field: hapflow_setting_info::reserved",
    ][::core::mem::offset_of!(hapflow_setting_info, reserved) - 12usize];
    [
        "Offset of field: hapflow_setting_info::min",
    ][::core::mem::offset_of!(hapflow_setting_info, min) - 16usize];
    [
        "Offset of field: hapflow_setting_info::max",
    ][::core::mem::offset_of!(hapflow_setting_info, max) - 24usize];
    [
        "Offset of field: hapflow_setting_info::path",
    ][::core::mem::offset_of!(hapflow_setting_info, path) - 32usize];
    [
        "Offset of field: hapflow_setting_info::group",
    ][::core::mem::offset_of!(hapflow_setting_info, group) - 40usize];
    [
        "Offset of field: hapflow_setting_info::unit",
    ][::core::mem::offset_of!(hapflow_setting_info, unit) - 48usize];
    [
        "Offset of field: hapflow_setting_info::about",
    ][::core::mem::offset_of!(hapflow_setting_info, about) - 56usize];
    [
        "Offset of field: hapflow_setting_info::choices",
    ][::core::mem::offset_of!(hapflow_setting_info, choices) - 64usize];
    [
        "Offset of field: hapflow_setting_info::usual",
    ][::core::mem::offset_of!(hapflow_setting_info, usual) - 72usize];
};
pub const HAPFLOW_PRIORITY_NOT_ASKED: _bindgen_ty_7 = 0;
pub const HAPFLOW_PRIORITY_GRANTED: _bindgen_ty_7 = 1;
pub const HAPFLOW_PRIORITY_REFUSED: _bindgen_ty_7 = 2;
pub type _bindgen_ty_7 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_servo_pace {
    pub size: u32,
    pub owned: u32,
    pub running: u32,
    pub priority: u32,
    pub ticks: u64,
    pub late: u64,
    pub median_s: f64,
    pub p99_s: f64,
    pub longest_s: f64,
    pub priority_text: *const ::core::ffi::c_char,
    pub device: *const ::core::ffi::c_char,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_servo_pace",
    ][::core::mem::size_of::<hapflow_servo_pace>() - 72usize];
    [
        "Alignment of hapflow_servo_pace",
    ][::core::mem::align_of::<hapflow_servo_pace>() - 8usize];
    [
        "Offset of field: hapflow_servo_pace::size",
    ][::core::mem::offset_of!(hapflow_servo_pace, size) - 0usize];
    [
        "Offset of field: hapflow_servo_pace::owned",
    ][::core::mem::offset_of!(hapflow_servo_pace, owned) - 4usize];
    [
        "Offset of field: hapflow_servo_pace::running",
    ][::core::mem::offset_of!(hapflow_servo_pace, running) - 8usize];
    [
        "Offset of field: hapflow_servo_pace::priority",
    ][::core::mem::offset_of!(hapflow_servo_pace, priority) - 12usize];
    [
        "Offset of field: hapflow_servo_pace::ticks",
    ][::core::mem::offset_of!(hapflow_servo_pace, ticks) - 16usize];
    [
        "Offset of field: hapflow_servo_pace::late",
    ][::core::mem::offset_of!(hapflow_servo_pace, late) - 24usize];
    [
        "Offset of field: hapflow_servo_pace::median_s",
    ][::core::mem::offset_of!(hapflow_servo_pace, median_s) - 32usize];
    [
        "Offset of field: hapflow_servo_pace::p99_s",
    ][::core::mem::offset_of!(hapflow_servo_pace, p99_s) - 40usize];
    [
        "Offset of field: hapflow_servo_pace::longest_s",
    ][::core::mem::offset_of!(hapflow_servo_pace, longest_s) - 48usize];
    [
        "Offset of field: hapflow_servo_pace::priority_text",
    ][::core::mem::offset_of!(hapflow_servo_pace, priority_text) - 56usize];
    [
        "Offset of field: hapflow_servo_pace::device",
    ][::core::mem::offset_of!(hapflow_servo_pace, device) - 64usize];
};
pub const HAPFLOW_BODY_TOOL: _bindgen_ty_8 = 1;
pub const HAPFLOW_BODY_OBSTACLE: _bindgen_ty_8 = 2;
pub const HAPFLOW_BODY_FREE: _bindgen_ty_8 = 3;
pub type _bindgen_ty_8 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_body_report {
    pub size: u32,
    pub reserved: u32,
    pub position: [f64; 3usize],
    pub orientation: [f64; 4usize],
    pub velocity: [f64; 3usize],
    pub angular_velocity: [f64; 3usize],
    pub pressure_force: [f64; 3usize],
    pub viscous_force: [f64; 3usize],
    pub torque: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_body_report",
    ][::core::mem::size_of::<hapflow_body_report>() - 184usize];
    [
        "Alignment of hapflow_body_report",
    ][::core::mem::align_of::<hapflow_body_report>() - 8usize];
    [
        "Offset of field: hapflow_body_report::size",
    ][::core::mem::offset_of!(hapflow_body_report, size) - 0usize];
    [
        "Offset of field: hapflow_body_report::reserved",
    ][::core::mem::offset_of!(hapflow_body_report, reserved) - 4usize];
    [
        "Offset of field: hapflow_body_report::position",
    ][::core::mem::offset_of!(hapflow_body_report, position) - 8usize];
    [
        "Offset of field: hapflow_body_report::orientation",
    ][::core::mem::offset_of!(hapflow_body_report, orientation) - 32usize];
    [
        "Offset of field: hapflow_body_report::velocity",
    ][::core::mem::offset_of!(hapflow_body_report, velocity) - 64usize];
    [
        "Offset of field: hapflow_body_report::angular_velocity",
    ][::core::mem::offset_of!(hapflow_body_report, angular_velocity) - 88usize];
    [
        "Offset of field: hapflow_body_report::pressure_force",
    ][::core::mem::offset_of!(hapflow_body_report, pressure_force) - 112usize];
    [
        "Offset of field: hapflow_body_report::viscous_force",
    ][::core::mem::offset_of!(hapflow_body_report, viscous_force) - 136usize];
    [
        "Offset of field: hapflow_body_report::torque",
    ][::core::mem::offset_of!(hapflow_body_report, torque) - 160usize];
};
pub const HAPFLOW_FAULT_INPUT: _bindgen_ty_9 = 1;
pub const HAPFLOW_FAULT_FORCE: _bindgen_ty_9 = 2;
pub const HAPFLOW_FAULT_PANIC: _bindgen_ty_9 = 4;
pub const HAPFLOW_FAULT_DEVICE_LOST: _bindgen_ty_9 = 16;
pub const HAPFLOW_FAULT_EMERGENCY_STOP: _bindgen_ty_9 = 32;
pub const HAPFLOW_FAULT_FLUID: _bindgen_ty_9 = 128;
pub const HAPFLOW_FAULT_STALE: _bindgen_ty_9 = 8;
pub const HAPFLOW_FAULT_PATH_OVERFLOW: _bindgen_ty_9 = 64;
pub const HAPFLOW_FAULT_LATE_TICK: _bindgen_ty_9 = 256;
pub const HAPFLOW_FAULT_FORCE_LIMITED: _bindgen_ty_9 = 512;
pub const HAPFLOW_FAULT_SLEW_LIMITED: _bindgen_ty_9 = 1024;
pub type _bindgen_ty_9 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_report {
    pub size: u32,
    pub faults: u32,
    pub tick: u64,
    pub time_s: f64,
    pub position: [f64; 3usize],
    pub body: [f64; 3usize],
    pub raw_force: [f64; 3usize],
    pub raw_torque: [f64; 3usize],
    pub force: [f64; 3usize],
    pub torque: [f64; 3usize],
    pub model_frame: u64,
    pub model_age_s: f64,
    pub fluid_frame: u64,
    pub fluid_time_s: f64,
    pub particles: u64,
    pub substeps: u64,
    pub max_speed: f64,
    pub load_force: [f64; 3usize],
    pub load_torque: [f64; 3usize],
    pub degraded: u64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of hapflow_report"][::core::mem::size_of::<hapflow_report>() - 280usize];
    ["Alignment of hapflow_report"][::core::mem::align_of::<hapflow_report>() - 8usize];
    [
        "Offset of field: hapflow_report::size",
    ][::core::mem::offset_of!(hapflow_report, size) - 0usize];
    [
        "Offset of field: hapflow_report::faults",
    ][::core::mem::offset_of!(hapflow_report, faults) - 4usize];
    [
        "Offset of field: hapflow_report::tick",
    ][::core::mem::offset_of!(hapflow_report, tick) - 8usize];
    [
        "Offset of field: hapflow_report::time_s",
    ][::core::mem::offset_of!(hapflow_report, time_s) - 16usize];
    [
        "Offset of field: hapflow_report::position",
    ][::core::mem::offset_of!(hapflow_report, position) - 24usize];
    [
        "Offset of field: hapflow_report::body",
    ][::core::mem::offset_of!(hapflow_report, body) - 48usize];
    [
        "Offset of field: hapflow_report::raw_force",
    ][::core::mem::offset_of!(hapflow_report, raw_force) - 72usize];
    [
        "Offset of field: hapflow_report::raw_torque",
    ][::core::mem::offset_of!(hapflow_report, raw_torque) - 96usize];
    [
        "Offset of field: hapflow_report::force",
    ][::core::mem::offset_of!(hapflow_report, force) - 120usize];
    [
        "Offset of field: hapflow_report::torque",
    ][::core::mem::offset_of!(hapflow_report, torque) - 144usize];
    [
        "Offset of field: hapflow_report::model_frame",
    ][::core::mem::offset_of!(hapflow_report, model_frame) - 168usize];
    [
        "Offset of field: hapflow_report::model_age_s",
    ][::core::mem::offset_of!(hapflow_report, model_age_s) - 176usize];
    [
        "Offset of field: hapflow_report::fluid_frame",
    ][::core::mem::offset_of!(hapflow_report, fluid_frame) - 184usize];
    [
        "Offset of field: hapflow_report::fluid_time_s",
    ][::core::mem::offset_of!(hapflow_report, fluid_time_s) - 192usize];
    [
        "Offset of field: hapflow_report::particles",
    ][::core::mem::offset_of!(hapflow_report, particles) - 200usize];
    [
        "Offset of field: hapflow_report::substeps",
    ][::core::mem::offset_of!(hapflow_report, substeps) - 208usize];
    [
        "Offset of field: hapflow_report::max_speed",
    ][::core::mem::offset_of!(hapflow_report, max_speed) - 216usize];
    [
        "Offset of field: hapflow_report::load_force",
    ][::core::mem::offset_of!(hapflow_report, load_force) - 224usize];
    [
        "Offset of field: hapflow_report::load_torque",
    ][::core::mem::offset_of!(hapflow_report, load_torque) - 248usize];
    [
        "Offset of field: hapflow_report::degraded",
    ][::core::mem::offset_of!(hapflow_report, degraded) - 272usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_device_extension {
    pub size: u32,
    pub reserved: u32,
    pub config_init: ::core::option::Option<
        unsafe extern "C" fn(
            config: *mut hapflow_device_config,
            size: u32,
        ) -> hapflow_result,
    >,
    pub open: ::core::option::Option<
        unsafe extern "C" fn(
            config: *const hapflow_device_config,
            device: *mut hapflow_device,
        ) -> hapflow_result,
    >,
    pub close: ::core::option::Option<
        unsafe extern "C" fn(device: hapflow_device) -> hapflow_result,
    >,
    pub read: ::core::option::Option<
        unsafe extern "C" fn(
            device: hapflow_device,
            time_s: f64,
            state: *mut hapflow_tool_state,
        ) -> hapflow_result,
    >,
    pub write: ::core::option::Option<
        unsafe extern "C" fn(
            device: hapflow_device,
            wrench: *const hapflow_wrench,
            dt_s: f64,
        ) -> hapflow_result,
    >,
    pub clear_faults: ::core::option::Option<
        unsafe extern "C" fn(device: hapflow_device) -> hapflow_result,
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_device_extension",
    ][::core::mem::size_of::<hapflow_device_extension>() - 56usize];
    [
        "Alignment of hapflow_device_extension",
    ][::core::mem::align_of::<hapflow_device_extension>() - 8usize];
    [
        "Offset of field: hapflow_device_extension::size",
    ][::core::mem::offset_of!(hapflow_device_extension, size) - 0usize];
    [
        "Offset of field: hapflow_device_extension::reserved",
    ][::core::mem::offset_of!(hapflow_device_extension, reserved) - 4usize];
    [
        "Offset of field: hapflow_device_extension::config_init",
    ][::core::mem::offset_of!(hapflow_device_extension, config_init) - 8usize];
    [
        "Offset of field: hapflow_device_extension::open",
    ][::core::mem::offset_of!(hapflow_device_extension, open) - 16usize];
    [
        "Offset of field: hapflow_device_extension::close",
    ][::core::mem::offset_of!(hapflow_device_extension, close) - 24usize];
    [
        "Offset of field: hapflow_device_extension::read",
    ][::core::mem::offset_of!(hapflow_device_extension, read) - 32usize];
    [
        "Offset of field: hapflow_device_extension::write",
    ][::core::mem::offset_of!(hapflow_device_extension, write) - 40usize];
    [
        "Offset of field: hapflow_device_extension::clear_faults",
    ][::core::mem::offset_of!(hapflow_device_extension, clear_faults) - 48usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_log_extension {
    pub size: u32,
    pub reserved: u32,
    pub poll: ::core::option::Option<
        unsafe extern "C" fn(session: hapflow_session) -> hapflow_result,
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_log_extension",
    ][::core::mem::size_of::<hapflow_log_extension>() - 16usize];
    [
        "Alignment of hapflow_log_extension",
    ][::core::mem::align_of::<hapflow_log_extension>() - 8usize];
    [
        "Offset of field: hapflow_log_extension::size",
    ][::core::mem::offset_of!(hapflow_log_extension, size) - 0usize];
    [
        "Offset of field: hapflow_log_extension::reserved",
    ][::core::mem::offset_of!(hapflow_log_extension, reserved) - 4usize];
    [
        "Offset of field: hapflow_log_extension::poll",
    ][::core::mem::offset_of!(hapflow_log_extension, poll) - 8usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_box {
    pub min: [f64; 3usize],
    pub max: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of hapflow_fluid_box"][::core::mem::size_of::<hapflow_fluid_box>() - 48usize];
    [
        "Alignment of hapflow_fluid_box",
    ][::core::mem::align_of::<hapflow_fluid_box>() - 8usize];
    [
        "Offset of field: hapflow_fluid_box::min",
    ][::core::mem::offset_of!(hapflow_fluid_box, min) - 0usize];
    [
        "Offset of field: hapflow_fluid_box::max",
    ][::core::mem::offset_of!(hapflow_fluid_box, max) - 24usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_source {
    pub position: [f64; 3usize],
    pub direction: [f64; 3usize],
    pub diameter: f64,
    pub speed: f64,
    pub period: f64,
    pub duty: f64,
    pub on: u32,
    pub reserved: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_source",
    ][::core::mem::size_of::<hapflow_fluid_source>() - 88usize];
    [
        "Alignment of hapflow_fluid_source",
    ][::core::mem::align_of::<hapflow_fluid_source>() - 8usize];
    [
        "Offset of field: hapflow_fluid_source::position",
    ][::core::mem::offset_of!(hapflow_fluid_source, position) - 0usize];
    [
        "Offset of field: hapflow_fluid_source::direction",
    ][::core::mem::offset_of!(hapflow_fluid_source, direction) - 24usize];
    [
        "Offset of field: hapflow_fluid_source::diameter",
    ][::core::mem::offset_of!(hapflow_fluid_source, diameter) - 48usize];
    [
        "Offset of field: hapflow_fluid_source::speed",
    ][::core::mem::offset_of!(hapflow_fluid_source, speed) - 56usize];
    [
        "Offset of field: hapflow_fluid_source::period",
    ][::core::mem::offset_of!(hapflow_fluid_source, period) - 64usize];
    [
        "Offset of field: hapflow_fluid_source::duty",
    ][::core::mem::offset_of!(hapflow_fluid_source, duty) - 72usize];
    [
        "Offset of field: hapflow_fluid_source::on",
    ][::core::mem::offset_of!(hapflow_fluid_source, on) - 80usize];
    [
        "Offset of field: hapflow_fluid_source::reserved",
    ][::core::mem::offset_of!(hapflow_fluid_source, reserved) - 84usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_body {
    pub shape: u32,
    pub reserved: u32,
    pub radius: f64,
    pub length: f64,
    pub extent: [f64; 3usize],
    pub bounding_radius: f64,
    pub mass: f64,
    pub position: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_body",
    ][::core::mem::size_of::<hapflow_fluid_body>() - 88usize];
    [
        "Alignment of hapflow_fluid_body",
    ][::core::mem::align_of::<hapflow_fluid_body>() - 8usize];
    [
        "Offset of field: hapflow_fluid_body::shape",
    ][::core::mem::offset_of!(hapflow_fluid_body, shape) - 0usize];
    [
        "Offset of field: hapflow_fluid_body::reserved",
    ][::core::mem::offset_of!(hapflow_fluid_body, reserved) - 4usize];
    [
        "Offset of field: hapflow_fluid_body::radius",
    ][::core::mem::offset_of!(hapflow_fluid_body, radius) - 8usize];
    [
        "Offset of field: hapflow_fluid_body::length",
    ][::core::mem::offset_of!(hapflow_fluid_body, length) - 16usize];
    [
        "Offset of field: hapflow_fluid_body::extent",
    ][::core::mem::offset_of!(hapflow_fluid_body, extent) - 24usize];
    [
        "Offset of field: hapflow_fluid_body::bounding_radius",
    ][::core::mem::offset_of!(hapflow_fluid_body, bounding_radius) - 48usize];
    [
        "Offset of field: hapflow_fluid_body::mass",
    ][::core::mem::offset_of!(hapflow_fluid_body, mass) - 56usize];
    [
        "Offset of field: hapflow_fluid_body::position",
    ][::core::mem::offset_of!(hapflow_fluid_body, position) - 64usize];
};
pub const HAPFLOW_CONTAINER_NONE: _bindgen_ty_10 = 0;
pub const HAPFLOW_CONTAINER_BOX: _bindgen_ty_10 = 1;
pub const HAPFLOW_CONTAINER_CYLINDER: _bindgen_ty_10 = 2;
pub const HAPFLOW_CONTAINER_BOWL: _bindgen_ty_10 = 3;
pub type _bindgen_ty_10 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_config {
    pub size: u32,
    pub threads: u32,
    pub frame_hz: f64,
    pub density: f64,
    pub viscosity: f64,
    pub surface_tension: f64,
    pub spacing: f64,
    pub gravity: [f64; 3usize],
    pub two_way: u32,
    pub has_ground: u32,
    pub ground: f64,
    pub bounds: hapflow_fluid_box,
    pub container: u32,
    pub periodic: u32,
    pub inside: hapflow_fluid_box,
    pub source_count: u32,
    pub pool_count: u32,
    pub sink_count: u32,
    pub body_count: u32,
    pub sources: *const hapflow_fluid_source,
    pub pools: *const hapflow_fluid_box,
    pub sinks: *const hapflow_fluid_box,
    pub bodies: *const hapflow_fluid_body,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_config",
    ][::core::mem::size_of::<hapflow_fluid_config>() - 240usize];
    [
        "Alignment of hapflow_fluid_config",
    ][::core::mem::align_of::<hapflow_fluid_config>() - 8usize];
    [
        "Offset of field: hapflow_fluid_config::size",
    ][::core::mem::offset_of!(hapflow_fluid_config, size) - 0usize];
    [
        "Offset of field: hapflow_fluid_config::threads",
    ][::core::mem::offset_of!(hapflow_fluid_config, threads) - 4usize];
    [
        "Offset of field: hapflow_fluid_config::frame_hz",
    ][::core::mem::offset_of!(hapflow_fluid_config, frame_hz) - 8usize];
    [
        "Offset of field: hapflow_fluid_config::density",
    ][::core::mem::offset_of!(hapflow_fluid_config, density) - 16usize];
    [
        "Offset of field: hapflow_fluid_config::viscosity",
    ][::core::mem::offset_of!(hapflow_fluid_config, viscosity) - 24usize];
    [
        "Offset of field: hapflow_fluid_config::surface_tension",
    ][::core::mem::offset_of!(hapflow_fluid_config, surface_tension) - 32usize];
    [
        "Offset of field: hapflow_fluid_config::spacing",
    ][::core::mem::offset_of!(hapflow_fluid_config, spacing) - 40usize];
    [
        "Offset of field: hapflow_fluid_config::gravity",
    ][::core::mem::offset_of!(hapflow_fluid_config, gravity) - 48usize];
    [
        "Offset of field: hapflow_fluid_config::two_way",
    ][::core::mem::offset_of!(hapflow_fluid_config, two_way) - 72usize];
    [
        "Offset of field: hapflow_fluid_config::has_ground",
    ][::core::mem::offset_of!(hapflow_fluid_config, has_ground) - 76usize];
    [
        "Offset of field: hapflow_fluid_config::ground",
    ][::core::mem::offset_of!(hapflow_fluid_config, ground) - 80usize];
    [
        "Offset of field: hapflow_fluid_config::bounds",
    ][::core::mem::offset_of!(hapflow_fluid_config, bounds) - 88usize];
    [
        "Offset of field: hapflow_fluid_config::container",
    ][::core::mem::offset_of!(hapflow_fluid_config, container) - 136usize];
    [
        "Offset of field: hapflow_fluid_config::periodic",
    ][::core::mem::offset_of!(hapflow_fluid_config, periodic) - 140usize];
    [
        "Offset of field: hapflow_fluid_config::inside",
    ][::core::mem::offset_of!(hapflow_fluid_config, inside) - 144usize];
    [
        "Offset of field: hapflow_fluid_config::source_count",
    ][::core::mem::offset_of!(hapflow_fluid_config, source_count) - 192usize];
    [
        "Offset of field: hapflow_fluid_config::pool_count",
    ][::core::mem::offset_of!(hapflow_fluid_config, pool_count) - 196usize];
    [
        "Offset of field: hapflow_fluid_config::sink_count",
    ][::core::mem::offset_of!(hapflow_fluid_config, sink_count) - 200usize];
    [
        "Offset of field: hapflow_fluid_config::body_count",
    ][::core::mem::offset_of!(hapflow_fluid_config, body_count) - 204usize];
    [
        "Offset of field: hapflow_fluid_config::sources",
    ][::core::mem::offset_of!(hapflow_fluid_config, sources) - 208usize];
    [
        "Offset of field: hapflow_fluid_config::pools",
    ][::core::mem::offset_of!(hapflow_fluid_config, pools) - 216usize];
    [
        "Offset of field: hapflow_fluid_config::sinks",
    ][::core::mem::offset_of!(hapflow_fluid_config, sinks) - 224usize];
    [
        "Offset of field: hapflow_fluid_config::bodies",
    ][::core::mem::offset_of!(hapflow_fluid_config, bodies) - 232usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_sample {
    pub time_s: f64,
    pub position: [f64; 3usize],
    pub orientation: [f64; 4usize],
    pub velocity: [f64; 3usize],
    pub angular_velocity: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_sample",
    ][::core::mem::size_of::<hapflow_fluid_sample>() - 112usize];
    [
        "Alignment of hapflow_fluid_sample",
    ][::core::mem::align_of::<hapflow_fluid_sample>() - 8usize];
    [
        "Offset of field: hapflow_fluid_sample::time_s",
    ][::core::mem::offset_of!(hapflow_fluid_sample, time_s) - 0usize];
    [
        "Offset of field: hapflow_fluid_sample::position",
    ][::core::mem::offset_of!(hapflow_fluid_sample, position) - 8usize];
    [
        "Offset of field: hapflow_fluid_sample::orientation",
    ][::core::mem::offset_of!(hapflow_fluid_sample, orientation) - 32usize];
    [
        "Offset of field: hapflow_fluid_sample::velocity",
    ][::core::mem::offset_of!(hapflow_fluid_sample, velocity) - 64usize];
    [
        "Offset of field: hapflow_fluid_sample::angular_velocity",
    ][::core::mem::offset_of!(hapflow_fluid_sample, angular_velocity) - 88usize];
};
pub const HAPFLOW_MOTION_LED: _bindgen_ty_11 = 1;
pub const HAPFLOW_MOTION_DRIVEN: _bindgen_ty_11 = 2;
pub const HAPFLOW_MOTION_FLOATING: _bindgen_ty_11 = 3;
pub type _bindgen_ty_11 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_motion {
    pub drive: u32,
    pub sample_count: u32,
    pub velocity: [f64; 3usize],
    pub path: *const hapflow_fluid_sample,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_motion",
    ][::core::mem::size_of::<hapflow_fluid_motion>() - 40usize];
    [
        "Alignment of hapflow_fluid_motion",
    ][::core::mem::align_of::<hapflow_fluid_motion>() - 8usize];
    [
        "Offset of field: hapflow_fluid_motion::drive",
    ][::core::mem::offset_of!(hapflow_fluid_motion, drive) - 0usize];
    [
        "Offset of field: hapflow_fluid_motion::sample_count",
    ][::core::mem::offset_of!(hapflow_fluid_motion, sample_count) - 4usize];
    [
        "Offset of field: hapflow_fluid_motion::velocity",
    ][::core::mem::offset_of!(hapflow_fluid_motion, velocity) - 8usize];
    [
        "Offset of field: hapflow_fluid_motion::path",
    ][::core::mem::offset_of!(hapflow_fluid_motion, path) - 32usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_frame {
    pub size: u32,
    pub body_count: u32,
    pub duration_s: f64,
    pub motions: *const hapflow_fluid_motion,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_frame",
    ][::core::mem::size_of::<hapflow_fluid_frame>() - 24usize];
    [
        "Alignment of hapflow_fluid_frame",
    ][::core::mem::align_of::<hapflow_fluid_frame>() - 8usize];
    [
        "Offset of field: hapflow_fluid_frame::size",
    ][::core::mem::offset_of!(hapflow_fluid_frame, size) - 0usize];
    [
        "Offset of field: hapflow_fluid_frame::body_count",
    ][::core::mem::offset_of!(hapflow_fluid_frame, body_count) - 4usize];
    [
        "Offset of field: hapflow_fluid_frame::duration_s",
    ][::core::mem::offset_of!(hapflow_fluid_frame, duration_s) - 8usize];
    [
        "Offset of field: hapflow_fluid_frame::motions",
    ][::core::mem::offset_of!(hapflow_fluid_frame, motions) - 16usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_load {
    pub pressure_force: [f64; 3usize],
    pub viscous_force: [f64; 3usize],
    pub torque: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_load",
    ][::core::mem::size_of::<hapflow_fluid_load>() - 72usize];
    [
        "Alignment of hapflow_fluid_load",
    ][::core::mem::align_of::<hapflow_fluid_load>() - 8usize];
    [
        "Offset of field: hapflow_fluid_load::pressure_force",
    ][::core::mem::offset_of!(hapflow_fluid_load, pressure_force) - 0usize];
    [
        "Offset of field: hapflow_fluid_load::viscous_force",
    ][::core::mem::offset_of!(hapflow_fluid_load, viscous_force) - 24usize];
    [
        "Offset of field: hapflow_fluid_load::torque",
    ][::core::mem::offset_of!(hapflow_fluid_load, torque) - 48usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_result {
    pub size: u32,
    pub degraded: u32,
    pub particles: u64,
    pub substeps: u64,
    pub max_speed: f64,
    pub loads: *mut hapflow_fluid_load,
    pub states: *mut hapflow_fluid_sample,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_result",
    ][::core::mem::size_of::<hapflow_fluid_result>() - 48usize];
    [
        "Alignment of hapflow_fluid_result",
    ][::core::mem::align_of::<hapflow_fluid_result>() - 8usize];
    [
        "Offset of field: hapflow_fluid_result::size",
    ][::core::mem::offset_of!(hapflow_fluid_result, size) - 0usize];
    [
        "Offset of field: hapflow_fluid_result::degraded",
    ][::core::mem::offset_of!(hapflow_fluid_result, degraded) - 4usize];
    [
        "Offset of field: hapflow_fluid_result::particles",
    ][::core::mem::offset_of!(hapflow_fluid_result, particles) - 8usize];
    [
        "Offset of field: hapflow_fluid_result::substeps",
    ][::core::mem::offset_of!(hapflow_fluid_result, substeps) - 16usize];
    [
        "Offset of field: hapflow_fluid_result::max_speed",
    ][::core::mem::offset_of!(hapflow_fluid_result, max_speed) - 24usize];
    [
        "Offset of field: hapflow_fluid_result::loads",
    ][::core::mem::offset_of!(hapflow_fluid_result, loads) - 32usize];
    [
        "Offset of field: hapflow_fluid_result::states",
    ][::core::mem::offset_of!(hapflow_fluid_result, states) - 40usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_fluid_backend_extension {
    pub size: u32,
    pub reserved: u32,
    pub name: *const ::core::ffi::c_char,
    pub create: ::core::option::Option<
        unsafe extern "C" fn(
            config: *const hapflow_fluid_config,
            fluid: *mut *mut ::core::ffi::c_void,
            reason: *mut ::core::ffi::c_char,
            capacity: usize,
        ) -> hapflow_result,
    >,
    pub configure: ::core::option::Option<
        unsafe extern "C" fn(
            fluid: *mut ::core::ffi::c_void,
            config: *const hapflow_fluid_config,
            reason: *mut ::core::ffi::c_char,
            capacity: usize,
        ) -> hapflow_result,
    >,
    pub step: ::core::option::Option<
        unsafe extern "C" fn(
            fluid: *mut ::core::ffi::c_void,
            frame: *const hapflow_fluid_frame,
            result: *mut hapflow_fluid_result,
        ) -> hapflow_result,
    >,
    pub particles: ::core::option::Option<
        unsafe extern "C" fn(
            fluid: *mut ::core::ffi::c_void,
            positions: *mut f32,
            capacity: usize,
            count: *mut usize,
        ) -> hapflow_result,
    >,
    pub destroy: ::core::option::Option<
        unsafe extern "C" fn(fluid: *mut ::core::ffi::c_void),
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_fluid_backend_extension",
    ][::core::mem::size_of::<hapflow_fluid_backend_extension>() - 56usize];
    [
        "Alignment of hapflow_fluid_backend_extension",
    ][::core::mem::align_of::<hapflow_fluid_backend_extension>() - 8usize];
    [
        "Offset of field: hapflow_fluid_backend_extension::size",
    ][::core::mem::offset_of!(hapflow_fluid_backend_extension, size) - 0usize];
    [
        "Offset of field: hapflow_fluid_backend_extension::reserved",
    ][::core::mem::offset_of!(hapflow_fluid_backend_extension, reserved) - 4usize];
    [
        "Offset of field: hapflow_fluid_backend_extension::name",
    ][::core::mem::offset_of!(hapflow_fluid_backend_extension, name) - 8usize];
    [
        "Offset of field: hapflow_fluid_backend_extension::create",
    ][::core::mem::offset_of!(hapflow_fluid_backend_extension, create) - 16usize];
    [
        "Offset of field: hapflow_fluid_backend_extension::configure",
    ][::core::mem::offset_of!(hapflow_fluid_backend_extension, configure) - 24usize];
    [
        "Offset of field: hapflow_fluid_backend_extension::step",
    ][::core::mem::offset_of!(hapflow_fluid_backend_extension, step) - 32usize];
    [
        "Offset of field: hapflow_fluid_backend_extension::particles",
    ][::core::mem::offset_of!(hapflow_fluid_backend_extension, particles) - 40usize];
    [
        "Offset of field: hapflow_fluid_backend_extension::destroy",
    ][::core::mem::offset_of!(hapflow_fluid_backend_extension, destroy) - 48usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_coupling_frame {
    pub size: u32,
    pub reserved: u32,
    pub frame_s: f64,
    pub body_position: [f64; 3usize],
    pub body_velocity: [f64; 3usize],
    pub body_mass: f64,
    pub hand_position: [f64; 3usize],
    pub hand_velocity: [f64; 3usize],
    pub load: hapflow_wrench,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_coupling_frame",
    ][::core::mem::size_of::<hapflow_coupling_frame>() - 168usize];
    [
        "Alignment of hapflow_coupling_frame",
    ][::core::mem::align_of::<hapflow_coupling_frame>() - 8usize];
    [
        "Offset of field: hapflow_coupling_frame::size",
    ][::core::mem::offset_of!(hapflow_coupling_frame, size) - 0usize];
    [
        "Offset of field: hapflow_coupling_frame::reserved",
    ][::core::mem::offset_of!(hapflow_coupling_frame, reserved) - 4usize];
    [
        "Offset of field: hapflow_coupling_frame::frame_s",
    ][::core::mem::offset_of!(hapflow_coupling_frame, frame_s) - 8usize];
    [
        "Offset of field: hapflow_coupling_frame::body_position",
    ][::core::mem::offset_of!(hapflow_coupling_frame, body_position) - 16usize];
    [
        "Offset of field: hapflow_coupling_frame::body_velocity",
    ][::core::mem::offset_of!(hapflow_coupling_frame, body_velocity) - 40usize];
    [
        "Offset of field: hapflow_coupling_frame::body_mass",
    ][::core::mem::offset_of!(hapflow_coupling_frame, body_mass) - 64usize];
    [
        "Offset of field: hapflow_coupling_frame::hand_position",
    ][::core::mem::offset_of!(hapflow_coupling_frame, hand_position) - 72usize];
    [
        "Offset of field: hapflow_coupling_frame::hand_velocity",
    ][::core::mem::offset_of!(hapflow_coupling_frame, hand_velocity) - 96usize];
    [
        "Offset of field: hapflow_coupling_frame::load",
    ][::core::mem::offset_of!(hapflow_coupling_frame, load) - 120usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_coupling_extension {
    pub size: u32,
    pub reserved: u32,
    pub name: *const ::core::ffi::c_char,
    pub create: ::core::option::Option<
        unsafe extern "C" fn(coupling: *mut *mut ::core::ffi::c_void) -> hapflow_result,
    >,
    pub begin: ::core::option::Option<
        unsafe extern "C" fn(
            coupling: *mut ::core::ffi::c_void,
            frame: *const hapflow_coupling_frame,
            driven: *mut u32,
            velocity: *mut f64,
        ) -> hapflow_result,
    >,
    pub end: ::core::option::Option<
        unsafe extern "C" fn(
            coupling: *mut ::core::ffi::c_void,
            frame: *const hapflow_coupling_frame,
            felt: *mut hapflow_wrench,
        ) -> hapflow_result,
    >,
    pub destroy: ::core::option::Option<
        unsafe extern "C" fn(coupling: *mut ::core::ffi::c_void),
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    [
        "Size of hapflow_coupling_extension",
    ][::core::mem::size_of::<hapflow_coupling_extension>() - 48usize];
    [
        "Alignment of hapflow_coupling_extension",
    ][::core::mem::align_of::<hapflow_coupling_extension>() - 8usize];
    [
        "Offset of field: hapflow_coupling_extension::size",
    ][::core::mem::offset_of!(hapflow_coupling_extension, size) - 0usize];
    [
        "Offset of field: hapflow_coupling_extension::reserved",
    ][::core::mem::offset_of!(hapflow_coupling_extension, reserved) - 4usize];
    [
        "Offset of field: hapflow_coupling_extension::name",
    ][::core::mem::offset_of!(hapflow_coupling_extension, name) - 8usize];
    [
        "Offset of field: hapflow_coupling_extension::create",
    ][::core::mem::offset_of!(hapflow_coupling_extension, create) - 16usize];
    [
        "Offset of field: hapflow_coupling_extension::begin",
    ][::core::mem::offset_of!(hapflow_coupling_extension, begin) - 24usize];
    [
        "Offset of field: hapflow_coupling_extension::end",
    ][::core::mem::offset_of!(hapflow_coupling_extension, end) - 32usize];
    [
        "Offset of field: hapflow_coupling_extension::destroy",
    ][::core::mem::offset_of!(hapflow_coupling_extension, destroy) - 40usize];
};
pub const HAPFLOW_SOLID_GROUND: _bindgen_ty_12 = 1;
pub const HAPFLOW_SOLID_CONTAINER: _bindgen_ty_12 = 2;
pub const HAPFLOW_SOLID_OBSTACLE: _bindgen_ty_12 = 3;
pub type _bindgen_ty_12 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct hapflow_contact {
    pub solid: u32,
    pub index: u32,
    pub depth: f64,
    pub point: [f64; 3usize],
    pub normal: [f64; 3usize],
    pub force: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of hapflow_contact"][::core::mem::size_of::<hapflow_contact>() - 88usize];
    [
        "Alignment of hapflow_contact",
    ][::core::mem::align_of::<hapflow_contact>() - 8usize];
    [
        "Offset of field: hapflow_contact::solid",
    ][::core::mem::offset_of!(hapflow_contact, solid) - 0usize];
    [
        "Offset of field: hapflow_contact::index",
    ][::core::mem::offset_of!(hapflow_contact, index) - 4usize];
    [
        "Offset of field: hapflow_contact::depth",
    ][::core::mem::offset_of!(hapflow_contact, depth) - 8usize];
    [
        "Offset of field: hapflow_contact::point",
    ][::core::mem::offset_of!(hapflow_contact, point) - 16usize];
    [
        "Offset of field: hapflow_contact::normal",
    ][::core::mem::offset_of!(hapflow_contact, normal) - 40usize];
    [
        "Offset of field: hapflow_contact::force",
    ][::core::mem::offset_of!(hapflow_contact, force) - 64usize];
};
pub struct Functions {
    __library: ::libloading::Library,
    pub hapflow_result_text: unsafe extern "C" fn(
        result: hapflow_result,
    ) -> *const ::core::ffi::c_char,
    pub hapflow_last_error: unsafe extern "C" fn(
        text: *mut ::core::ffi::c_char,
        capacity: usize,
        length: *mut usize,
    ) -> hapflow_result,
    pub hapflow_negotiate: unsafe extern "C" fn(
        oldest: u32,
        newest: u32,
        chosen: *mut u32,
    ) -> hapflow_result,
    pub hapflow_version: unsafe extern "C" fn() -> u32,
    pub hapflow_build_info: unsafe extern "C" fn(
        text: *mut ::core::ffi::c_char,
        capacity: usize,
        length: *mut usize,
    ) -> hapflow_result,
    pub hapflow_scene_info_init: unsafe extern "C" fn(
        info: *mut hapflow_scene_info,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_scene_count: unsafe extern "C" fn() -> u32,
    pub hapflow_scene_get: unsafe extern "C" fn(
        index: u32,
        info: *mut hapflow_scene_info,
    ) -> hapflow_result,
    pub hapflow_scene_create: unsafe extern "C" fn(
        scene: *mut hapflow_scene,
    ) -> hapflow_result,
    pub hapflow_scene_load: unsafe extern "C" fn(
        name: *const ::core::ffi::c_char,
        scene: *mut hapflow_scene,
    ) -> hapflow_result,
    pub hapflow_scene_parse: unsafe extern "C" fn(
        toml: *const ::core::ffi::c_char,
        length: usize,
        scene: *mut hapflow_scene,
    ) -> hapflow_result,
    pub hapflow_scene_destroy: unsafe extern "C" fn(
        scene: hapflow_scene,
    ) -> hapflow_result,
    pub hapflow_scene_set: unsafe extern "C" fn(
        scene: hapflow_scene,
        path: *const ::core::ffi::c_char,
        value: f64,
    ) -> hapflow_result,
    pub hapflow_scene_set_vector: unsafe extern "C" fn(
        scene: hapflow_scene,
        path: *const ::core::ffi::c_char,
        value: *const f64,
    ) -> hapflow_result,
    pub hapflow_scene_set_text: unsafe extern "C" fn(
        scene: hapflow_scene,
        path: *const ::core::ffi::c_char,
        value: *const ::core::ffi::c_char,
    ) -> hapflow_result,
    pub hapflow_scene_set_bounds: unsafe extern "C" fn(
        scene: hapflow_scene,
        min: *const f64,
        max: *const f64,
    ) -> hapflow_result,
    pub hapflow_scene_set_periodic: unsafe extern "C" fn(
        scene: hapflow_scene,
        axes: u32,
    ) -> hapflow_result,
    pub hapflow_scene_set_ground: unsafe extern "C" fn(
        scene: hapflow_scene,
        height: *const f64,
    ) -> hapflow_result,
    pub hapflow_scene_set_container: unsafe extern "C" fn(
        scene: hapflow_scene,
        min: *const f64,
        max: *const f64,
    ) -> hapflow_result,
    pub hapflow_source_config_init: unsafe extern "C" fn(
        config: *mut hapflow_source_config,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_scene_add_source: unsafe extern "C" fn(
        scene: hapflow_scene,
        config: *const hapflow_source_config,
        index: *mut u32,
    ) -> hapflow_result,
    pub hapflow_obstacle_config_init: unsafe extern "C" fn(
        config: *mut hapflow_obstacle_config,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_scene_add_obstacle: unsafe extern "C" fn(
        scene: hapflow_scene,
        config: *const hapflow_obstacle_config,
        index: *mut u32,
    ) -> hapflow_result,
    pub hapflow_tool_config_init: unsafe extern "C" fn(
        config: *mut hapflow_tool_config,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_scene_add_tool: unsafe extern "C" fn(
        scene: hapflow_scene,
        config: *const hapflow_tool_config,
        index: *mut u32,
    ) -> hapflow_result,
    pub hapflow_body_config_init: unsafe extern "C" fn(
        config: *mut hapflow_body_config,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_scene_add_body: unsafe extern "C" fn(
        scene: hapflow_scene,
        config: *const hapflow_body_config,
        index: *mut u32,
    ) -> hapflow_result,
    pub hapflow_scene_add_pool: unsafe extern "C" fn(
        scene: hapflow_scene,
        min: *const f64,
        max: *const f64,
        index: *mut u32,
    ) -> hapflow_result,
    pub hapflow_scene_add_sink: unsafe extern "C" fn(
        scene: hapflow_scene,
        min: *const f64,
        max: *const f64,
        index: *mut u32,
    ) -> hapflow_result,
    pub hapflow_scene_add_change: unsafe extern "C" fn(
        scene: hapflow_scene,
        at_s: f64,
        settings: *const ::core::ffi::c_char,
    ) -> hapflow_result,
    pub hapflow_scene_check: unsafe extern "C" fn(
        scene: hapflow_scene,
    ) -> hapflow_result,
    pub hapflow_scene_write: unsafe extern "C" fn(
        scene: hapflow_scene,
        text: *mut ::core::ffi::c_char,
        capacity: usize,
        length: *mut usize,
    ) -> hapflow_result,
    pub hapflow_tool_state_init: unsafe extern "C" fn(
        state: *mut hapflow_tool_state,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_device_info_init: unsafe extern "C" fn(
        info: *mut hapflow_device_info,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_device_count: unsafe extern "C" fn() -> u32,
    pub hapflow_device_get: unsafe extern "C" fn(
        index: u32,
        info: *mut hapflow_device_info,
    ) -> hapflow_result,
    pub hapflow_device_config_init: unsafe extern "C" fn(
        config: *mut hapflow_device_config,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_device_open: unsafe extern "C" fn(
        config: *const hapflow_device_config,
        device: *mut hapflow_device,
    ) -> hapflow_result,
    pub hapflow_device_close: unsafe extern "C" fn(
        device: hapflow_device,
    ) -> hapflow_result,
    pub hapflow_device_read: unsafe extern "C" fn(
        device: hapflow_device,
        time_s: f64,
        state: *mut hapflow_tool_state,
    ) -> hapflow_result,
    pub hapflow_device_write: unsafe extern "C" fn(
        device: hapflow_device,
        wrench: *const hapflow_wrench,
        dt_s: f64,
    ) -> hapflow_result,
    pub hapflow_device_clear_faults: unsafe extern "C" fn(
        device: hapflow_device,
    ) -> hapflow_result,
    pub hapflow_session_config_init: unsafe extern "C" fn(
        config: *mut hapflow_session_config,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_session_create: unsafe extern "C" fn(
        config: *const hapflow_session_config,
        session: *mut hapflow_session,
    ) -> hapflow_result,
    pub hapflow_session_destroy: unsafe extern "C" fn(
        session: hapflow_session,
    ) -> hapflow_result,
    pub hapflow_session_emergency_stop: unsafe extern "C" fn(
        session: hapflow_session,
    ) -> hapflow_result,
    pub hapflow_session_clear_faults: unsafe extern "C" fn(
        session: hapflow_session,
    ) -> hapflow_result,
    pub hapflow_session_limit_force: unsafe extern "C" fn(
        session: hapflow_session,
        max_force: f64,
        max_torque: f64,
    ) -> hapflow_result,
    pub hapflow_session_set: unsafe extern "C" fn(
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        value: f64,
    ) -> hapflow_result,
    pub hapflow_session_set_vector: unsafe extern "C" fn(
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        value: *const f64,
    ) -> hapflow_result,
    pub hapflow_session_set_text: unsafe extern "C" fn(
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        value: *const ::core::ffi::c_char,
    ) -> hapflow_result,
    pub hapflow_session_get: unsafe extern "C" fn(
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        value: *mut f64,
    ) -> hapflow_result,
    pub hapflow_session_get_text: unsafe extern "C" fn(
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        text: *mut ::core::ffi::c_char,
        capacity: usize,
        length: *mut usize,
    ) -> hapflow_result,
    pub hapflow_setting_info_init: unsafe extern "C" fn(
        info: *mut hapflow_setting_info,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_session_setting_count: unsafe extern "C" fn(
        session: hapflow_session,
        count: *mut u32,
    ) -> hapflow_result,
    pub hapflow_session_setting_info: unsafe extern "C" fn(
        session: hapflow_session,
        index: u32,
        info: *mut hapflow_setting_info,
    ) -> hapflow_result,
    pub hapflow_session_tool_count: unsafe extern "C" fn(
        session: hapflow_session,
        count: *mut u32,
    ) -> hapflow_result,
    pub hapflow_servo_tick: unsafe extern "C" fn(
        session: hapflow_session,
        state: *const hapflow_tool_state,
        wrench: *mut hapflow_wrench,
    ) -> hapflow_result,
    pub hapflow_servo_pace_init: unsafe extern "C" fn(
        pace: *mut hapflow_servo_pace,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_session_servo_pace: unsafe extern "C" fn(
        session: hapflow_session,
        tool: u32,
        pace: *mut hapflow_servo_pace,
    ) -> hapflow_result,
    pub hapflow_fluid_advance: unsafe extern "C" fn(
        session: hapflow_session,
        time_s: f64,
    ) -> hapflow_result,
    pub hapflow_fluid_step: unsafe extern "C" fn(
        session: hapflow_session,
        end_s: f64,
    ) -> hapflow_result,
    pub hapflow_fluid_particles: unsafe extern "C" fn(
        session: hapflow_session,
        positions: *mut f32,
        capacity: usize,
        count: *mut usize,
    ) -> hapflow_result,
    pub hapflow_session_particles: unsafe extern "C" fn(
        session: hapflow_session,
        positions: *mut f32,
        capacity: usize,
        count: *mut usize,
    ) -> hapflow_result,
    pub hapflow_obstacle_count: unsafe extern "C" fn(
        session: hapflow_session,
        count: *mut u32,
    ) -> hapflow_result,
    pub hapflow_obstacle_move: unsafe extern "C" fn(
        session: hapflow_session,
        index: u32,
        position: *const f64,
        orientation: *const f64,
    ) -> hapflow_result,
    pub hapflow_obstacle_publish: unsafe extern "C" fn(
        session: hapflow_session,
    ) -> hapflow_result,
    pub hapflow_body_report_init: unsafe extern "C" fn(
        report: *mut hapflow_body_report,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_session_body_report: unsafe extern "C" fn(
        session: hapflow_session,
        which: u32,
        index: u32,
        report: *mut hapflow_body_report,
    ) -> hapflow_result,
    pub hapflow_report_init: unsafe extern "C" fn(
        report: *mut hapflow_report,
        size: u32,
    ) -> hapflow_result,
    pub hapflow_session_report: unsafe extern "C" fn(
        session: hapflow_session,
        report: *mut hapflow_report,
    ) -> hapflow_result,
    pub hapflow_session_report_of: unsafe extern "C" fn(
        session: hapflow_session,
        tool: u32,
        report: *mut hapflow_report,
    ) -> hapflow_result,
    pub hapflow_session_poll: unsafe extern "C" fn(
        session: hapflow_session,
    ) -> hapflow_result,
    pub hapflow_extension: unsafe extern "C" fn(
        name: *const ::core::ffi::c_char,
    ) -> *const ::core::ffi::c_void,
    pub hapflow_session_contacts: unsafe extern "C" fn(
        session: hapflow_session,
        tool: u32,
        contacts: *mut hapflow_contact,
        size: u32,
        capacity: usize,
        count: *mut usize,
    ) -> hapflow_result,
    pub hapflow_session_proxy: unsafe extern "C" fn(
        session: hapflow_session,
        tool: u32,
        position: *mut f64,
        orientation: *mut f64,
    ) -> hapflow_result,
    pub hapflow_session_record: unsafe extern "C" fn(
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
    ) -> hapflow_result,
    pub hapflow_session_record_stop: unsafe extern "C" fn(
        session: hapflow_session,
        ticks: *mut u64,
        lost: *mut u64,
    ) -> hapflow_result,
}
impl Functions {
    pub unsafe fn new<P>(path: P) -> Result<Self, ::libloading::Error>
    where
        P: AsRef<::std::ffi::OsStr>,
    {
        let path = path.as_ref();
        let library = ::libloading::Library::new(path)?;
        Self::from_library(library)
    }
    pub unsafe fn from_library<L>(library: L) -> Result<Self, ::libloading::Error>
    where
        L: Into<::libloading::Library>,
    {
        let __library = library.into();
        let hapflow_result_text = __library
            .get(b"hapflow_result_text\0")
            .map(|sym| *sym)?;
        let hapflow_last_error = __library.get(b"hapflow_last_error\0").map(|sym| *sym)?;
        let hapflow_negotiate = __library.get(b"hapflow_negotiate\0").map(|sym| *sym)?;
        let hapflow_version = __library.get(b"hapflow_version\0").map(|sym| *sym)?;
        let hapflow_build_info = __library.get(b"hapflow_build_info\0").map(|sym| *sym)?;
        let hapflow_scene_info_init = __library
            .get(b"hapflow_scene_info_init\0")
            .map(|sym| *sym)?;
        let hapflow_scene_count = __library
            .get(b"hapflow_scene_count\0")
            .map(|sym| *sym)?;
        let hapflow_scene_get = __library.get(b"hapflow_scene_get\0").map(|sym| *sym)?;
        let hapflow_scene_create = __library
            .get(b"hapflow_scene_create\0")
            .map(|sym| *sym)?;
        let hapflow_scene_load = __library.get(b"hapflow_scene_load\0").map(|sym| *sym)?;
        let hapflow_scene_parse = __library
            .get(b"hapflow_scene_parse\0")
            .map(|sym| *sym)?;
        let hapflow_scene_destroy = __library
            .get(b"hapflow_scene_destroy\0")
            .map(|sym| *sym)?;
        let hapflow_scene_set = __library.get(b"hapflow_scene_set\0").map(|sym| *sym)?;
        let hapflow_scene_set_vector = __library
            .get(b"hapflow_scene_set_vector\0")
            .map(|sym| *sym)?;
        let hapflow_scene_set_text = __library
            .get(b"hapflow_scene_set_text\0")
            .map(|sym| *sym)?;
        let hapflow_scene_set_bounds = __library
            .get(b"hapflow_scene_set_bounds\0")
            .map(|sym| *sym)?;
        let hapflow_scene_set_periodic = __library
            .get(b"hapflow_scene_set_periodic\0")
            .map(|sym| *sym)?;
        let hapflow_scene_set_ground = __library
            .get(b"hapflow_scene_set_ground\0")
            .map(|sym| *sym)?;
        let hapflow_scene_set_container = __library
            .get(b"hapflow_scene_set_container\0")
            .map(|sym| *sym)?;
        let hapflow_source_config_init = __library
            .get(b"hapflow_source_config_init\0")
            .map(|sym| *sym)?;
        let hapflow_scene_add_source = __library
            .get(b"hapflow_scene_add_source\0")
            .map(|sym| *sym)?;
        let hapflow_obstacle_config_init = __library
            .get(b"hapflow_obstacle_config_init\0")
            .map(|sym| *sym)?;
        let hapflow_scene_add_obstacle = __library
            .get(b"hapflow_scene_add_obstacle\0")
            .map(|sym| *sym)?;
        let hapflow_tool_config_init = __library
            .get(b"hapflow_tool_config_init\0")
            .map(|sym| *sym)?;
        let hapflow_scene_add_tool = __library
            .get(b"hapflow_scene_add_tool\0")
            .map(|sym| *sym)?;
        let hapflow_body_config_init = __library
            .get(b"hapflow_body_config_init\0")
            .map(|sym| *sym)?;
        let hapflow_scene_add_body = __library
            .get(b"hapflow_scene_add_body\0")
            .map(|sym| *sym)?;
        let hapflow_scene_add_pool = __library
            .get(b"hapflow_scene_add_pool\0")
            .map(|sym| *sym)?;
        let hapflow_scene_add_sink = __library
            .get(b"hapflow_scene_add_sink\0")
            .map(|sym| *sym)?;
        let hapflow_scene_add_change = __library
            .get(b"hapflow_scene_add_change\0")
            .map(|sym| *sym)?;
        let hapflow_scene_check = __library
            .get(b"hapflow_scene_check\0")
            .map(|sym| *sym)?;
        let hapflow_scene_write = __library
            .get(b"hapflow_scene_write\0")
            .map(|sym| *sym)?;
        let hapflow_tool_state_init = __library
            .get(b"hapflow_tool_state_init\0")
            .map(|sym| *sym)?;
        let hapflow_device_info_init = __library
            .get(b"hapflow_device_info_init\0")
            .map(|sym| *sym)?;
        let hapflow_device_count = __library
            .get(b"hapflow_device_count\0")
            .map(|sym| *sym)?;
        let hapflow_device_get = __library.get(b"hapflow_device_get\0").map(|sym| *sym)?;
        let hapflow_device_config_init = __library
            .get(b"hapflow_device_config_init\0")
            .map(|sym| *sym)?;
        let hapflow_device_open = __library
            .get(b"hapflow_device_open\0")
            .map(|sym| *sym)?;
        let hapflow_device_close = __library
            .get(b"hapflow_device_close\0")
            .map(|sym| *sym)?;
        let hapflow_device_read = __library
            .get(b"hapflow_device_read\0")
            .map(|sym| *sym)?;
        let hapflow_device_write = __library
            .get(b"hapflow_device_write\0")
            .map(|sym| *sym)?;
        let hapflow_device_clear_faults = __library
            .get(b"hapflow_device_clear_faults\0")
            .map(|sym| *sym)?;
        let hapflow_session_config_init = __library
            .get(b"hapflow_session_config_init\0")
            .map(|sym| *sym)?;
        let hapflow_session_create = __library
            .get(b"hapflow_session_create\0")
            .map(|sym| *sym)?;
        let hapflow_session_destroy = __library
            .get(b"hapflow_session_destroy\0")
            .map(|sym| *sym)?;
        let hapflow_session_emergency_stop = __library
            .get(b"hapflow_session_emergency_stop\0")
            .map(|sym| *sym)?;
        let hapflow_session_clear_faults = __library
            .get(b"hapflow_session_clear_faults\0")
            .map(|sym| *sym)?;
        let hapflow_session_limit_force = __library
            .get(b"hapflow_session_limit_force\0")
            .map(|sym| *sym)?;
        let hapflow_session_set = __library
            .get(b"hapflow_session_set\0")
            .map(|sym| *sym)?;
        let hapflow_session_set_vector = __library
            .get(b"hapflow_session_set_vector\0")
            .map(|sym| *sym)?;
        let hapflow_session_set_text = __library
            .get(b"hapflow_session_set_text\0")
            .map(|sym| *sym)?;
        let hapflow_session_get = __library
            .get(b"hapflow_session_get\0")
            .map(|sym| *sym)?;
        let hapflow_session_get_text = __library
            .get(b"hapflow_session_get_text\0")
            .map(|sym| *sym)?;
        let hapflow_setting_info_init = __library
            .get(b"hapflow_setting_info_init\0")
            .map(|sym| *sym)?;
        let hapflow_session_setting_count = __library
            .get(b"hapflow_session_setting_count\0")
            .map(|sym| *sym)?;
        let hapflow_session_setting_info = __library
            .get(b"hapflow_session_setting_info\0")
            .map(|sym| *sym)?;
        let hapflow_session_tool_count = __library
            .get(b"hapflow_session_tool_count\0")
            .map(|sym| *sym)?;
        let hapflow_servo_tick = __library.get(b"hapflow_servo_tick\0").map(|sym| *sym)?;
        let hapflow_servo_pace_init = __library
            .get(b"hapflow_servo_pace_init\0")
            .map(|sym| *sym)?;
        let hapflow_session_servo_pace = __library
            .get(b"hapflow_session_servo_pace\0")
            .map(|sym| *sym)?;
        let hapflow_fluid_advance = __library
            .get(b"hapflow_fluid_advance\0")
            .map(|sym| *sym)?;
        let hapflow_fluid_step = __library.get(b"hapflow_fluid_step\0").map(|sym| *sym)?;
        let hapflow_fluid_particles = __library
            .get(b"hapflow_fluid_particles\0")
            .map(|sym| *sym)?;
        let hapflow_session_particles = __library
            .get(b"hapflow_session_particles\0")
            .map(|sym| *sym)?;
        let hapflow_obstacle_count = __library
            .get(b"hapflow_obstacle_count\0")
            .map(|sym| *sym)?;
        let hapflow_obstacle_move = __library
            .get(b"hapflow_obstacle_move\0")
            .map(|sym| *sym)?;
        let hapflow_obstacle_publish = __library
            .get(b"hapflow_obstacle_publish\0")
            .map(|sym| *sym)?;
        let hapflow_body_report_init = __library
            .get(b"hapflow_body_report_init\0")
            .map(|sym| *sym)?;
        let hapflow_session_body_report = __library
            .get(b"hapflow_session_body_report\0")
            .map(|sym| *sym)?;
        let hapflow_report_init = __library
            .get(b"hapflow_report_init\0")
            .map(|sym| *sym)?;
        let hapflow_session_report = __library
            .get(b"hapflow_session_report\0")
            .map(|sym| *sym)?;
        let hapflow_session_report_of = __library
            .get(b"hapflow_session_report_of\0")
            .map(|sym| *sym)?;
        let hapflow_session_poll = __library
            .get(b"hapflow_session_poll\0")
            .map(|sym| *sym)?;
        let hapflow_extension = __library.get(b"hapflow_extension\0").map(|sym| *sym)?;
        let hapflow_session_contacts = __library
            .get(b"hapflow_session_contacts\0")
            .map(|sym| *sym)?;
        let hapflow_session_proxy = __library
            .get(b"hapflow_session_proxy\0")
            .map(|sym| *sym)?;
        let hapflow_session_record = __library
            .get(b"hapflow_session_record\0")
            .map(|sym| *sym)?;
        let hapflow_session_record_stop = __library
            .get(b"hapflow_session_record_stop\0")
            .map(|sym| *sym)?;
        Ok(Functions {
            __library,
            hapflow_result_text,
            hapflow_last_error,
            hapflow_negotiate,
            hapflow_version,
            hapflow_build_info,
            hapflow_scene_info_init,
            hapflow_scene_count,
            hapflow_scene_get,
            hapflow_scene_create,
            hapflow_scene_load,
            hapflow_scene_parse,
            hapflow_scene_destroy,
            hapflow_scene_set,
            hapflow_scene_set_vector,
            hapflow_scene_set_text,
            hapflow_scene_set_bounds,
            hapflow_scene_set_periodic,
            hapflow_scene_set_ground,
            hapflow_scene_set_container,
            hapflow_source_config_init,
            hapflow_scene_add_source,
            hapflow_obstacle_config_init,
            hapflow_scene_add_obstacle,
            hapflow_tool_config_init,
            hapflow_scene_add_tool,
            hapflow_body_config_init,
            hapflow_scene_add_body,
            hapflow_scene_add_pool,
            hapflow_scene_add_sink,
            hapflow_scene_add_change,
            hapflow_scene_check,
            hapflow_scene_write,
            hapflow_tool_state_init,
            hapflow_device_info_init,
            hapflow_device_count,
            hapflow_device_get,
            hapflow_device_config_init,
            hapflow_device_open,
            hapflow_device_close,
            hapflow_device_read,
            hapflow_device_write,
            hapflow_device_clear_faults,
            hapflow_session_config_init,
            hapflow_session_create,
            hapflow_session_destroy,
            hapflow_session_emergency_stop,
            hapflow_session_clear_faults,
            hapflow_session_limit_force,
            hapflow_session_set,
            hapflow_session_set_vector,
            hapflow_session_set_text,
            hapflow_session_get,
            hapflow_session_get_text,
            hapflow_setting_info_init,
            hapflow_session_setting_count,
            hapflow_session_setting_info,
            hapflow_session_tool_count,
            hapflow_servo_tick,
            hapflow_servo_pace_init,
            hapflow_session_servo_pace,
            hapflow_fluid_advance,
            hapflow_fluid_step,
            hapflow_fluid_particles,
            hapflow_session_particles,
            hapflow_obstacle_count,
            hapflow_obstacle_move,
            hapflow_obstacle_publish,
            hapflow_body_report_init,
            hapflow_session_body_report,
            hapflow_report_init,
            hapflow_session_report,
            hapflow_session_report_of,
            hapflow_session_poll,
            hapflow_extension,
            hapflow_session_contacts,
            hapflow_session_proxy,
            hapflow_session_record,
            hapflow_session_record_stop,
        })
    }
    pub unsafe fn hapflow_result_text(
        &self,
        result: hapflow_result,
    ) -> *const ::core::ffi::c_char {
        (self.hapflow_result_text)(result)
    }
    pub unsafe fn hapflow_last_error(
        &self,
        text: *mut ::core::ffi::c_char,
        capacity: usize,
        length: *mut usize,
    ) -> hapflow_result {
        (self.hapflow_last_error)(text, capacity, length)
    }
    pub unsafe fn hapflow_negotiate(
        &self,
        oldest: u32,
        newest: u32,
        chosen: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_negotiate)(oldest, newest, chosen)
    }
    pub unsafe fn hapflow_version(&self) -> u32 {
        (self.hapflow_version)()
    }
    pub unsafe fn hapflow_build_info(
        &self,
        text: *mut ::core::ffi::c_char,
        capacity: usize,
        length: *mut usize,
    ) -> hapflow_result {
        (self.hapflow_build_info)(text, capacity, length)
    }
    pub unsafe fn hapflow_scene_info_init(
        &self,
        info: *mut hapflow_scene_info,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_scene_info_init)(info, size)
    }
    pub unsafe fn hapflow_scene_count(&self) -> u32 {
        (self.hapflow_scene_count)()
    }
    pub unsafe fn hapflow_scene_get(
        &self,
        index: u32,
        info: *mut hapflow_scene_info,
    ) -> hapflow_result {
        (self.hapflow_scene_get)(index, info)
    }
    pub unsafe fn hapflow_scene_create(
        &self,
        scene: *mut hapflow_scene,
    ) -> hapflow_result {
        (self.hapflow_scene_create)(scene)
    }
    pub unsafe fn hapflow_scene_load(
        &self,
        name: *const ::core::ffi::c_char,
        scene: *mut hapflow_scene,
    ) -> hapflow_result {
        (self.hapflow_scene_load)(name, scene)
    }
    pub unsafe fn hapflow_scene_parse(
        &self,
        toml: *const ::core::ffi::c_char,
        length: usize,
        scene: *mut hapflow_scene,
    ) -> hapflow_result {
        (self.hapflow_scene_parse)(toml, length, scene)
    }
    pub unsafe fn hapflow_scene_destroy(&self, scene: hapflow_scene) -> hapflow_result {
        (self.hapflow_scene_destroy)(scene)
    }
    pub unsafe fn hapflow_scene_set(
        &self,
        scene: hapflow_scene,
        path: *const ::core::ffi::c_char,
        value: f64,
    ) -> hapflow_result {
        (self.hapflow_scene_set)(scene, path, value)
    }
    pub unsafe fn hapflow_scene_set_vector(
        &self,
        scene: hapflow_scene,
        path: *const ::core::ffi::c_char,
        value: *const f64,
    ) -> hapflow_result {
        (self.hapflow_scene_set_vector)(scene, path, value)
    }
    pub unsafe fn hapflow_scene_set_text(
        &self,
        scene: hapflow_scene,
        path: *const ::core::ffi::c_char,
        value: *const ::core::ffi::c_char,
    ) -> hapflow_result {
        (self.hapflow_scene_set_text)(scene, path, value)
    }
    pub unsafe fn hapflow_scene_set_bounds(
        &self,
        scene: hapflow_scene,
        min: *const f64,
        max: *const f64,
    ) -> hapflow_result {
        (self.hapflow_scene_set_bounds)(scene, min, max)
    }
    pub unsafe fn hapflow_scene_set_periodic(
        &self,
        scene: hapflow_scene,
        axes: u32,
    ) -> hapflow_result {
        (self.hapflow_scene_set_periodic)(scene, axes)
    }
    pub unsafe fn hapflow_scene_set_ground(
        &self,
        scene: hapflow_scene,
        height: *const f64,
    ) -> hapflow_result {
        (self.hapflow_scene_set_ground)(scene, height)
    }
    pub unsafe fn hapflow_scene_set_container(
        &self,
        scene: hapflow_scene,
        min: *const f64,
        max: *const f64,
    ) -> hapflow_result {
        (self.hapflow_scene_set_container)(scene, min, max)
    }
    pub unsafe fn hapflow_source_config_init(
        &self,
        config: *mut hapflow_source_config,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_source_config_init)(config, size)
    }
    pub unsafe fn hapflow_scene_add_source(
        &self,
        scene: hapflow_scene,
        config: *const hapflow_source_config,
        index: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_scene_add_source)(scene, config, index)
    }
    pub unsafe fn hapflow_obstacle_config_init(
        &self,
        config: *mut hapflow_obstacle_config,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_obstacle_config_init)(config, size)
    }
    pub unsafe fn hapflow_scene_add_obstacle(
        &self,
        scene: hapflow_scene,
        config: *const hapflow_obstacle_config,
        index: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_scene_add_obstacle)(scene, config, index)
    }
    pub unsafe fn hapflow_tool_config_init(
        &self,
        config: *mut hapflow_tool_config,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_tool_config_init)(config, size)
    }
    pub unsafe fn hapflow_scene_add_tool(
        &self,
        scene: hapflow_scene,
        config: *const hapflow_tool_config,
        index: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_scene_add_tool)(scene, config, index)
    }
    pub unsafe fn hapflow_body_config_init(
        &self,
        config: *mut hapflow_body_config,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_body_config_init)(config, size)
    }
    pub unsafe fn hapflow_scene_add_body(
        &self,
        scene: hapflow_scene,
        config: *const hapflow_body_config,
        index: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_scene_add_body)(scene, config, index)
    }
    pub unsafe fn hapflow_scene_add_pool(
        &self,
        scene: hapflow_scene,
        min: *const f64,
        max: *const f64,
        index: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_scene_add_pool)(scene, min, max, index)
    }
    pub unsafe fn hapflow_scene_add_sink(
        &self,
        scene: hapflow_scene,
        min: *const f64,
        max: *const f64,
        index: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_scene_add_sink)(scene, min, max, index)
    }
    pub unsafe fn hapflow_scene_add_change(
        &self,
        scene: hapflow_scene,
        at_s: f64,
        settings: *const ::core::ffi::c_char,
    ) -> hapflow_result {
        (self.hapflow_scene_add_change)(scene, at_s, settings)
    }
    pub unsafe fn hapflow_scene_check(&self, scene: hapflow_scene) -> hapflow_result {
        (self.hapflow_scene_check)(scene)
    }
    pub unsafe fn hapflow_scene_write(
        &self,
        scene: hapflow_scene,
        text: *mut ::core::ffi::c_char,
        capacity: usize,
        length: *mut usize,
    ) -> hapflow_result {
        (self.hapflow_scene_write)(scene, text, capacity, length)
    }
    pub unsafe fn hapflow_tool_state_init(
        &self,
        state: *mut hapflow_tool_state,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_tool_state_init)(state, size)
    }
    pub unsafe fn hapflow_device_info_init(
        &self,
        info: *mut hapflow_device_info,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_device_info_init)(info, size)
    }
    pub unsafe fn hapflow_device_count(&self) -> u32 {
        (self.hapflow_device_count)()
    }
    pub unsafe fn hapflow_device_get(
        &self,
        index: u32,
        info: *mut hapflow_device_info,
    ) -> hapflow_result {
        (self.hapflow_device_get)(index, info)
    }
    pub unsafe fn hapflow_device_config_init(
        &self,
        config: *mut hapflow_device_config,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_device_config_init)(config, size)
    }
    pub unsafe fn hapflow_device_open(
        &self,
        config: *const hapflow_device_config,
        device: *mut hapflow_device,
    ) -> hapflow_result {
        (self.hapflow_device_open)(config, device)
    }
    pub unsafe fn hapflow_device_close(&self, device: hapflow_device) -> hapflow_result {
        (self.hapflow_device_close)(device)
    }
    pub unsafe fn hapflow_device_read(
        &self,
        device: hapflow_device,
        time_s: f64,
        state: *mut hapflow_tool_state,
    ) -> hapflow_result {
        (self.hapflow_device_read)(device, time_s, state)
    }
    pub unsafe fn hapflow_device_write(
        &self,
        device: hapflow_device,
        wrench: *const hapflow_wrench,
        dt_s: f64,
    ) -> hapflow_result {
        (self.hapflow_device_write)(device, wrench, dt_s)
    }
    pub unsafe fn hapflow_device_clear_faults(
        &self,
        device: hapflow_device,
    ) -> hapflow_result {
        (self.hapflow_device_clear_faults)(device)
    }
    pub unsafe fn hapflow_session_config_init(
        &self,
        config: *mut hapflow_session_config,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_session_config_init)(config, size)
    }
    pub unsafe fn hapflow_session_create(
        &self,
        config: *const hapflow_session_config,
        session: *mut hapflow_session,
    ) -> hapflow_result {
        (self.hapflow_session_create)(config, session)
    }
    pub unsafe fn hapflow_session_destroy(
        &self,
        session: hapflow_session,
    ) -> hapflow_result {
        (self.hapflow_session_destroy)(session)
    }
    pub unsafe fn hapflow_session_emergency_stop(
        &self,
        session: hapflow_session,
    ) -> hapflow_result {
        (self.hapflow_session_emergency_stop)(session)
    }
    pub unsafe fn hapflow_session_clear_faults(
        &self,
        session: hapflow_session,
    ) -> hapflow_result {
        (self.hapflow_session_clear_faults)(session)
    }
    pub unsafe fn hapflow_session_limit_force(
        &self,
        session: hapflow_session,
        max_force: f64,
        max_torque: f64,
    ) -> hapflow_result {
        (self.hapflow_session_limit_force)(session, max_force, max_torque)
    }
    pub unsafe fn hapflow_session_set(
        &self,
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        value: f64,
    ) -> hapflow_result {
        (self.hapflow_session_set)(session, path, value)
    }
    pub unsafe fn hapflow_session_set_vector(
        &self,
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        value: *const f64,
    ) -> hapflow_result {
        (self.hapflow_session_set_vector)(session, path, value)
    }
    pub unsafe fn hapflow_session_set_text(
        &self,
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        value: *const ::core::ffi::c_char,
    ) -> hapflow_result {
        (self.hapflow_session_set_text)(session, path, value)
    }
    pub unsafe fn hapflow_session_get(
        &self,
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        value: *mut f64,
    ) -> hapflow_result {
        (self.hapflow_session_get)(session, path, value)
    }
    pub unsafe fn hapflow_session_get_text(
        &self,
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
        text: *mut ::core::ffi::c_char,
        capacity: usize,
        length: *mut usize,
    ) -> hapflow_result {
        (self.hapflow_session_get_text)(session, path, text, capacity, length)
    }
    pub unsafe fn hapflow_setting_info_init(
        &self,
        info: *mut hapflow_setting_info,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_setting_info_init)(info, size)
    }
    pub unsafe fn hapflow_session_setting_count(
        &self,
        session: hapflow_session,
        count: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_session_setting_count)(session, count)
    }
    pub unsafe fn hapflow_session_setting_info(
        &self,
        session: hapflow_session,
        index: u32,
        info: *mut hapflow_setting_info,
    ) -> hapflow_result {
        (self.hapflow_session_setting_info)(session, index, info)
    }
    pub unsafe fn hapflow_session_tool_count(
        &self,
        session: hapflow_session,
        count: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_session_tool_count)(session, count)
    }
    pub unsafe fn hapflow_servo_tick(
        &self,
        session: hapflow_session,
        state: *const hapflow_tool_state,
        wrench: *mut hapflow_wrench,
    ) -> hapflow_result {
        (self.hapflow_servo_tick)(session, state, wrench)
    }
    pub unsafe fn hapflow_servo_pace_init(
        &self,
        pace: *mut hapflow_servo_pace,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_servo_pace_init)(pace, size)
    }
    pub unsafe fn hapflow_session_servo_pace(
        &self,
        session: hapflow_session,
        tool: u32,
        pace: *mut hapflow_servo_pace,
    ) -> hapflow_result {
        (self.hapflow_session_servo_pace)(session, tool, pace)
    }
    pub unsafe fn hapflow_fluid_advance(
        &self,
        session: hapflow_session,
        time_s: f64,
    ) -> hapflow_result {
        (self.hapflow_fluid_advance)(session, time_s)
    }
    pub unsafe fn hapflow_fluid_step(
        &self,
        session: hapflow_session,
        end_s: f64,
    ) -> hapflow_result {
        (self.hapflow_fluid_step)(session, end_s)
    }
    pub unsafe fn hapflow_fluid_particles(
        &self,
        session: hapflow_session,
        positions: *mut f32,
        capacity: usize,
        count: *mut usize,
    ) -> hapflow_result {
        (self.hapflow_fluid_particles)(session, positions, capacity, count)
    }
    pub unsafe fn hapflow_session_particles(
        &self,
        session: hapflow_session,
        positions: *mut f32,
        capacity: usize,
        count: *mut usize,
    ) -> hapflow_result {
        (self.hapflow_session_particles)(session, positions, capacity, count)
    }
    pub unsafe fn hapflow_obstacle_count(
        &self,
        session: hapflow_session,
        count: *mut u32,
    ) -> hapflow_result {
        (self.hapflow_obstacle_count)(session, count)
    }
    pub unsafe fn hapflow_obstacle_move(
        &self,
        session: hapflow_session,
        index: u32,
        position: *const f64,
        orientation: *const f64,
    ) -> hapflow_result {
        (self.hapflow_obstacle_move)(session, index, position, orientation)
    }
    pub unsafe fn hapflow_obstacle_publish(
        &self,
        session: hapflow_session,
    ) -> hapflow_result {
        (self.hapflow_obstacle_publish)(session)
    }
    pub unsafe fn hapflow_body_report_init(
        &self,
        report: *mut hapflow_body_report,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_body_report_init)(report, size)
    }
    pub unsafe fn hapflow_session_body_report(
        &self,
        session: hapflow_session,
        which: u32,
        index: u32,
        report: *mut hapflow_body_report,
    ) -> hapflow_result {
        (self.hapflow_session_body_report)(session, which, index, report)
    }
    pub unsafe fn hapflow_report_init(
        &self,
        report: *mut hapflow_report,
        size: u32,
    ) -> hapflow_result {
        (self.hapflow_report_init)(report, size)
    }
    pub unsafe fn hapflow_session_report(
        &self,
        session: hapflow_session,
        report: *mut hapflow_report,
    ) -> hapflow_result {
        (self.hapflow_session_report)(session, report)
    }
    pub unsafe fn hapflow_session_report_of(
        &self,
        session: hapflow_session,
        tool: u32,
        report: *mut hapflow_report,
    ) -> hapflow_result {
        (self.hapflow_session_report_of)(session, tool, report)
    }
    pub unsafe fn hapflow_session_poll(
        &self,
        session: hapflow_session,
    ) -> hapflow_result {
        (self.hapflow_session_poll)(session)
    }
    pub unsafe fn hapflow_extension(
        &self,
        name: *const ::core::ffi::c_char,
    ) -> *const ::core::ffi::c_void {
        (self.hapflow_extension)(name)
    }
    pub unsafe fn hapflow_session_contacts(
        &self,
        session: hapflow_session,
        tool: u32,
        contacts: *mut hapflow_contact,
        size: u32,
        capacity: usize,
        count: *mut usize,
    ) -> hapflow_result {
        (self.hapflow_session_contacts)(session, tool, contacts, size, capacity, count)
    }
    pub unsafe fn hapflow_session_proxy(
        &self,
        session: hapflow_session,
        tool: u32,
        position: *mut f64,
        orientation: *mut f64,
    ) -> hapflow_result {
        (self.hapflow_session_proxy)(session, tool, position, orientation)
    }
    pub unsafe fn hapflow_session_record(
        &self,
        session: hapflow_session,
        path: *const ::core::ffi::c_char,
    ) -> hapflow_result {
        (self.hapflow_session_record)(session, path)
    }
    pub unsafe fn hapflow_session_record_stop(
        &self,
        session: hapflow_session,
        ticks: *mut u64,
        lost: *mut u64,
    ) -> hapflow_result {
        (self.hapflow_session_record_stop)(session, ticks, lost)
    }
}
