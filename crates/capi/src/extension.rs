//! `hapflow_extension`: tables of the functions of the optional parts.

use crate::caller::{In, Out, Text};
use crate::code::Code;
use crate::contract::as_in_header;
use crate::device_config::DeviceConfig;
use crate::generated as c;
use crate::handle::{DeviceHandle, Handle};
use crate::tool_state::ToolStateRecord;
use crate::wrench::WrenchRecord;
use crate::{device, log};
use std::ffi::c_void;

/// `hapflow_device_extension`.
#[repr(C)]
struct DeviceTable {
    size: u32,
    reserved: u32,
    config_init: extern "C" fn(Out<DeviceConfig>, u32) -> Code,
    open: extern "C" fn(In<DeviceConfig>, Out<DeviceHandle>) -> Code,
    close: extern "C" fn(DeviceHandle) -> Code,
    read: extern "C" fn(DeviceHandle, f64, Out<ToolStateRecord>) -> Code,
    write: extern "C" fn(DeviceHandle, In<WrenchRecord>, f64) -> Code,
    clear_faults: extern "C" fn(DeviceHandle) -> Code,
}

as_in_header!(
    DeviceTable =
        hapflow_device_extension { size, reserved, config_init, open, close, read, write, clear_faults }
);

static DEVICE: DeviceTable = DeviceTable {
    size: size_of::<DeviceTable>() as u32,
    reserved: 0,
    config_init: device::hapflow_device_config_init,
    open: device::hapflow_device_open,
    close: device::hapflow_device_close,
    read: device::hapflow_device_read,
    write: device::hapflow_device_write,
    clear_faults: device::hapflow_device_clear_faults,
};

/// `hapflow_log_extension`.
#[repr(C)]
struct LogTable {
    size: u32,
    reserved: u32,
    poll: extern "C" fn(Handle) -> Code,
}

as_in_header!(LogTable = hapflow_log_extension { size, reserved, poll });

static LOG: LogTable =
    LogTable { size: size_of::<LogTable>() as u32, reserved: 0, poll: log::hapflow_session_poll };

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_extension(name: Text) -> *const c_void {
    let is =
        |wanted: &[u8]| name.read().is_ok_and(|name| wanted.strip_suffix(b"\0") == Some(name.as_bytes()));
    if cfg!(feature = "device") && is(c::HAPFLOW_EXTENSION_DEVICE) {
        (&raw const DEVICE).cast()
    } else if cfg!(feature = "log") && is(c::HAPFLOW_EXTENSION_LOG) {
        (&raw const LOG).cast()
    } else {
        std::ptr::null()
    }
}
