//! What stands here is what the header says: checked while compiling, against the header in Rust ([`crate::generated`]).
//!
//! The functions take the caller's memory as [`In`], [`Out`], [`Text`] and [`Buffer`], where C has pointers. [`Abi`]
//! says which pointer each of them is; with it, every struct's fields and every function's arguments are compared by
//! type, not only by size.

use crate::caller::{Buffer, In, LogFunction, LogUser, Out, Text};
use crate::code::Code;
use crate::generated as c;
use crate::handle::{DeviceHandle, Handle, Id, SceneHandle};
use crate::{
    body, body_config, build_info, catalog, config, contact, device, device_config, extension, fluid,
    library, log, obstacle, obstacle_config, recording, report, scene, servo, servo_pace, session,
    setting_info, source_config, tool_config, tool_state,
};
use std::ffi::{c_char, c_void};

/// A type, and what the header calls it.
pub trait Abi: Copy {
    /// The same in C.
    type C: Copy;
}

/// What a pointer points to; an array is passed as its first element.
pub trait Target {
    /// The same in C.
    type C;
}

macro_rules! same_in_c {
    ($($ours:ty = $theirs:ty),+ $(,)?) => {
        $(impl Abi for $ours { type C = $theirs; })+
    };
}

macro_rules! targets {
    ($($ours:ty = $theirs:ty),+ $(,)?) => {
        $(impl Target for $ours { type C = $theirs; })+
    };
}

same_in_c! {
    u32 = u32, u64 = u64, Id = u64, usize = usize, f64 = f64,
    [f64; 3] = [f64; 3], [f64; 4] = [f64; 4],
    Text = *const c_char, *const c_char = *const c_char, *const c_void = *const c_void,
    LogFunction = c::hapflow_log_function, LogUser = *mut c_void,
    Code = c::hapflow_result, SceneHandle = c::hapflow_scene, Handle = c::hapflow_session, DeviceHandle = c::hapflow_device,
}

targets! {
    u32 = u32, u64 = u64, usize = usize, f64 = f64, c_char = c_char,
    [f64; 3] = f64, [f64; 4] = f64, [f32; 3] = f32,
    Handle = c::hapflow_session, DeviceHandle = c::hapflow_device,
    SceneHandle = c::hapflow_scene,
    source_config::SourceConfig = c::hapflow_source_config,
    obstacle_config::ObstacleConfig = c::hapflow_obstacle_config,
    tool_config::ToolConfig = c::hapflow_tool_config,
    body_config::BodyConfig = c::hapflow_body_config,
    body::BodyRecord = c::hapflow_body_report,
    device_config::DeviceConfig = c::hapflow_device_config,
    servo_pace::ServoPaceRecord = c::hapflow_servo_pace,
    config::SessionConfig = c::hapflow_session_config,
    contact::ContactRecord = c::hapflow_contact,
    tool_state::ToolStateRecord = c::hapflow_tool_state,
    crate::wrench::WrenchRecord = c::hapflow_wrench,
    report::Report = c::hapflow_report,
    setting_info::SettingInfo = c::hapflow_setting_info,
    catalog::SceneRecord = c::hapflow_scene_info,
    catalog::DeviceRecord = c::hapflow_device_info,
}

impl<T: Target + Copy> Abi for In<T> {
    type C = *const T::C;
}

impl<T: Target + Copy> Abi for Out<T> {
    type C = *mut T::C;
}

impl<T: Target + Copy> Abi for Buffer<T> {
    type C = *mut T::C;
}

/// Compiles if the two are one type in C.
pub const fn same<T: Abi>(_: &T, _: &T::C) {}

/// Checks a struct, field by field: names, offsets and types. A field of the header that is not listed does not
/// compile.
macro_rules! as_in_header {
    ($ours:ident = $theirs:ident { $($field:ident),+ $(,)? }) => {
        const _: () = {
            use crate::generated::$theirs;
            use std::mem::offset_of;
            assert!(size_of::<$ours>() == size_of::<$theirs>() && align_of::<$ours>() == align_of::<$theirs>());
            $(assert!(offset_of!($ours, $field) == offset_of!($theirs, $field));)+
            #[allow(dead_code)]
            fn every_field(ours: &$ours, theirs: &$theirs) {
                let $theirs { $($field),+ } = theirs;
                $(crate::contract::same(&ours.$field, $field);)+
            }
        };
    };
}
pub(crate) use as_in_header;

/// A function, and its prototype in the header.
pub trait Function: Copy {
    /// The same in C.
    type C: Copy;
}

macro_rules! arities {
    ($(($($arg:ident),*))+) => {
        $(impl<R: Abi, $($arg: Abi),*> Function for extern "C" fn($($arg),*) -> R {
            type C = unsafe extern "C" fn($($arg::C),*) -> R::C;
        }

        // As a field of a table.
        impl<R: Abi, $($arg: Abi),*> Abi for extern "C" fn($($arg),*) -> R {
            type C = Option<<Self as Function>::C>;
        })+
    };
}

arities! { () (A) (A, B) (A, B, D) (A, B, D, E) (A, B, D, E, F) (A, B, D, E, F, G) }

/// Compiles if the two have the same arguments and result.
const fn same_function<F: Function>(_: F, _: F::C) {}

/// Checks functions.
macro_rules! functions {
    ($($file:ident::$name:ident($($any:tt),*);)+) => {
        const _: () = {
            $(same_function($file::$name as extern "C" fn($($any),*) -> _, c::$name);)+
        };

        #[cfg(test)]
        const FUNCTIONS: &[&str] = &[$(stringify!($name)),+];
    };
}

functions! {
    library::hapflow_result_text(_);
    library::hapflow_last_error(_, _, _);
    library::hapflow_negotiate(_, _, _);
    library::hapflow_version();
    build_info::hapflow_build_info(_, _, _);
    catalog::hapflow_scene_info_init(_, _);
    catalog::hapflow_scene_count();
    catalog::hapflow_scene_get(_, _);
    scene::hapflow_scene_create(_);
    scene::hapflow_scene_load(_, _);
    scene::hapflow_scene_parse(_, _, _);
    scene::hapflow_scene_destroy(_);
    scene::hapflow_scene_set(_, _, _);
    scene::hapflow_scene_set_vector(_, _, _);
    scene::hapflow_scene_set_text(_, _, _);
    scene::hapflow_scene_set_bounds(_, _, _);
    scene::hapflow_scene_set_periodic(_, _);
    scene::hapflow_scene_set_ground(_, _);
    scene::hapflow_scene_set_container(_, _, _);
    source_config::hapflow_source_config_init(_, _);
    scene::hapflow_scene_add_source(_, _, _);
    obstacle_config::hapflow_obstacle_config_init(_, _);
    scene::hapflow_scene_add_obstacle(_, _, _);
    tool_config::hapflow_tool_config_init(_, _);
    scene::hapflow_scene_add_tool(_, _, _);
    body_config::hapflow_body_config_init(_, _);
    scene::hapflow_scene_add_body(_, _, _);
    scene::hapflow_scene_add_pool(_, _, _, _);
    scene::hapflow_scene_add_sink(_, _, _, _);
    scene::hapflow_scene_add_change(_, _, _);
    scene::hapflow_scene_check(_);
    scene::hapflow_scene_write(_, _, _, _);
    tool_state::hapflow_tool_state_init(_, _);
    catalog::hapflow_device_info_init(_, _);
    catalog::hapflow_device_count();
    catalog::hapflow_device_get(_, _);
    device::hapflow_device_config_init(_, _);
    device::hapflow_device_open(_, _);
    device::hapflow_device_close(_);
    device::hapflow_device_read(_, _, _);
    device::hapflow_device_write(_, _, _);
    device::hapflow_device_clear_faults(_);
    config::hapflow_session_config_init(_, _);
    session::hapflow_session_create(_, _);
    session::hapflow_session_destroy(_);
    session::hapflow_session_emergency_stop(_);
    session::hapflow_session_clear_faults(_);
    session::hapflow_session_limit_force(_, _, _);
    session::hapflow_session_set(_, _, _);
    session::hapflow_session_set_vector(_, _, _);
    session::hapflow_session_set_text(_, _, _);
    session::hapflow_session_get(_, _, _);
    session::hapflow_session_get_text(_, _, _, _, _);
    setting_info::hapflow_setting_info_init(_, _);
    session::hapflow_session_setting_count(_, _);
    session::hapflow_session_setting_info(_, _, _);
    session::hapflow_session_tool_count(_, _);
    servo::hapflow_servo_tick(_, _, _);
    servo_pace::hapflow_servo_pace_init(_, _);
    session::hapflow_session_servo_pace(_, _, _);
    fluid::hapflow_fluid_advance(_, _);
    fluid::hapflow_fluid_step(_, _);
    fluid::hapflow_fluid_particles(_, _, _, _);
    session::hapflow_session_particles(_, _, _, _);
    obstacle::hapflow_obstacle_count(_, _);
    obstacle::hapflow_obstacle_move(_, _, _, _);
    obstacle::hapflow_obstacle_publish(_);
    body::hapflow_body_report_init(_, _);
    body::hapflow_session_body_report(_, _, _, _);
    report::hapflow_report_init(_, _);
    session::hapflow_session_report(_, _);
    session::hapflow_session_report_of(_, _, _);
    log::hapflow_session_poll(_);
    extension::hapflow_extension(_);
    contact::hapflow_session_contacts(_, _, _, _, _, _);
    contact::hapflow_session_proxy(_, _, _, _);
    recording::hapflow_session_record(_, _);
    recording::hapflow_session_record_stop(_, _, _);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_of_the_header_is_checked() {
        let generated = include_str!("generated.rs");
        let name = |line: &str| line.trim().strip_prefix("pub fn ")?.split_once('(').map(|f| f.0.to_string());
        let declared: Vec<_> = generated.lines().filter_map(name).collect();
        assert_eq!(declared, FUNCTIONS);
    }
}
