//! The functions of devices in a build without them.

use crate::caller::{In, Out};
use crate::code::{Code, Failure};
use crate::device_config::DeviceConfig;
use crate::handle::DeviceHandle;
use crate::tool_state::ToolStateRecord;
use crate::wrench::WrenchRecord;
use hapflow_devices::HapticDevice;

/// There are none to take.
pub fn take_over(_: &[DeviceHandle]) -> Result<Vec<Box<dyn HapticDevice>>, Failure> {
    let text = "device_count: must be 0, for this build has no devices of the host".into();
    Err(Failure { code: Code::ERROR_UNSUPPORTED, text })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_config_init(_: Out<DeviceConfig>, _: u32) -> Code {
    Code::ERROR_UNSUPPORTED
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_open(_: In<DeviceConfig>, _: Out<DeviceHandle>) -> Code {
    Code::ERROR_UNSUPPORTED
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_close(_: DeviceHandle) -> Code {
    Code::ERROR_UNSUPPORTED
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_read(_: DeviceHandle, _: f64, _: Out<ToolStateRecord>) -> Code {
    Code::ERROR_UNSUPPORTED
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_write(_: DeviceHandle, _: In<WrenchRecord>, _: f64) -> Code {
    Code::ERROR_UNSUPPORTED
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_device_clear_faults(_: DeviceHandle) -> Code {
    Code::ERROR_UNSUPPORTED
}
