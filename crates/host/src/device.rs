//! A haptic device of a plugin.

use crate::PluginError;
use crate::extension::{Library, Table};
use crate::generated::*;
use crate::limits::{FARTHEST, FASTEST, FASTEST_TURN, UNIT, within};
use glam::{DQuat, DVec3};
use hapflow_devices::{DeviceError, HapticDevice, Pacing};
use hapflow_haptics::{GatedWrench, ToolState};
use std::mem::{size_of, zeroed};

// SAFETY: numbers and functions that may be null.
unsafe impl Table for hapflow_device_extension {
    const NAME: &'static [u8] = HAPFLOW_EXTENSION_DEVICE;
}

type ConfigInit = unsafe extern "C" fn(*mut hapflow_device_config, u32) -> hapflow_result;
type Open = unsafe extern "C" fn(*const hapflow_device_config, *mut hapflow_device) -> hapflow_result;
type Close = unsafe extern "C" fn(hapflow_device) -> hapflow_result;
type Read = unsafe extern "C" fn(hapflow_device, f64, *mut hapflow_tool_state) -> hapflow_result;
type Write = unsafe extern "C" fn(hapflow_device, *const hapflow_wrench, f64) -> hapflow_result;

#[derive(Clone, Copy)]
struct Functions {
    name: &'static str,
    config_init: ConfigInit,
    open: Open,
    close: Close,
    read: Read,
    write: Write,
}

/// A plugin's own device, which can be opened.
#[derive(Clone)]
pub struct PluginDevice(Functions);

impl PluginDevice {
    pub(crate) fn of(library: &Library) -> Result<Option<Self>, PluginError> {
        let Some(table) = library.table::<hapflow_device_extension>()? else { return Ok(None) };
        Ok(Some(Self(Functions {
            config_init: library.required(table.config_init, "config_init")?,
            open: library.required(table.open, "open")?,
            close: library.required(table.close, "close")?,
            read: library.required(table.read, "read")?,
            write: library.required(table.write, "write")?,
            // As long as the library: for the process.
            name: library.word().leak(),
        })))
    }

    /// Its name: that of its file, `bobbing` of `libbobbing.so`.
    pub fn name(&self) -> &'static str {
        self.0.name
    }

    /// Opens it; its origin is then at `origin`, in the device frame of the scene's mapping, m.
    ///
    /// # Errors
    /// A device that cannot be opened.
    pub fn open(&self, origin: DVec3) -> Result<Box<dyn HapticDevice>, DeviceError> {
        let mut device = hapflow_device { id: 0 };
        // SAFETY: the init function makes a configuration of zeros, as large as its size says.
        let result = unsafe {
            let mut config: hapflow_device_config = zeroed();
            match (self.0.config_init)(&mut config, size_of::<hapflow_device_config>() as u32) {
                result if result < 0 => result,
                _ => (self.0.open)(&config, &mut device),
            }
        };
        if result < 0 {
            let (device, cause) = (self.0.name, format!("result {result}"));
            return Err(DeviceError::Refused { device, cause, remedy: "see that it is there and free" });
        }
        Ok(Box::new(Device { functions: self.0, device: Some(device), origin }))
    }
}

/// An open device; what it says, and what it is told, is checked on hapflow's side.
struct Device {
    functions: Functions,
    /// None once it is closed.
    device: Option<hapflow_device>,
    /// Where its own origin is, m.
    origin: DVec3,
}

/// The state as hapflow takes it; none if the numbers are none, or beyond what a tool may be.
fn checked(state: &hapflow_tool_state) -> Option<ToolState> {
    let orientation = DQuat::from_array(state.orientation);
    let sound = within(state.position, FARTHEST)
        && within(state.velocity, FASTEST)
        && within(state.angular_velocity, FASTEST_TURN)
        && (orientation.length() - 1.0).abs() <= UNIT;
    sound.then(|| ToolState {
        position: DVec3::from_array(state.position),
        orientation: orientation.normalize(),
        velocity: DVec3::from_array(state.velocity),
        angular_velocity: DVec3::from_array(state.angular_velocity),
        buttons: state.buttons,
    })
}

impl Device {
    fn device(&self) -> Result<hapflow_device, DeviceError> {
        self.device.ok_or(DeviceError::Closed { device: self.functions.name })
    }

    fn lost(&self, cause: &'static str) -> DeviceError {
        DeviceError::Lost { device: self.functions.name, cause, remedy: "see to it, and start again" }
    }
}

impl HapticDevice for Device {
    fn name(&self) -> &str {
        self.functions.name
    }

    fn pacing(&self) -> Pacing {
        Pacing::Timer
    }

    fn read(&mut self, time_s: f64) -> Result<ToolState, DeviceError> {
        let device = self.device()?;
        // SAFETY: plain numbers.
        let mut state: hapflow_tool_state = unsafe { zeroed() };
        state.size = size_of::<hapflow_tool_state>() as u32;
        state.orientation[3] = 1.0;
        // SAFETY: `state` is as large as its size says.
        if unsafe { (self.functions.read)(device, time_s, &mut state) } < 0 {
            return Err(self.lost("it cannot be read"));
        }
        let state = checked(&state).ok_or_else(|| self.lost("it says where it is in no numbers"))?;
        Ok(ToolState { position: state.position + self.origin, ..state })
    }

    fn write(&mut self, wrench: GatedWrench, dt_s: f64) -> Result<(), DeviceError> {
        let device = self.device()?;
        let wrench = hapflow_wrench { force: wrench.force().to_array(), torque: wrench.torque().to_array() };
        // SAFETY: the wrench is there for the call.
        match unsafe { (self.functions.write)(device, &wrench, dt_s) } {
            result if result < 0 => Err(self.lost("it takes no force")),
            _ => Ok(()),
        }
    }

    fn close(&mut self) {
        let Some(device) = self.device.take() else { return };
        // SAFETY: numbers alone. Nobody can do more about a device that does not close.
        unsafe {
            (self.functions.write)(device, &hapflow_wrench { force: [0.0; 3], torque: [0.0; 3] }, 0.0);
            (self.functions.close)(device);
        }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        self.close();
    }
}
