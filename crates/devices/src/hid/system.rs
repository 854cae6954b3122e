//! Reports of a HID device at this machine, by hidapi.

use super::{Gone, Reports};
use crate::DeviceError;
use hidapi::{DeviceInfo, HidApi, HidDevice};

/// 3Dconnexion's own devices, and those that it sold under Logitech's number.
const THREE_DCONNEXION: u16 = 0x256F;
const LOGITECH: u16 = 0x046D;
const LOGITECH_CAPS: std::ops::RangeInclusive<u16> = 0xC603..=0xC62F;
/// A multi-axis controller, of the generic desktop page (HID Usage Tables, 4). Systems that do not tell say 0.
const GENERIC_DESKTOP: u16 = 0x01;
const MULTI_AXIS: u16 = 0x08;

const PLUG: &str =
    "plug it in; on Linux its users need a udev rule for hidraw: KERNEL==\"hidraw*\", TAG+=\"uaccess\"";

/// The first cap that is plugged in.
pub fn open(device: &'static str) -> Result<Box<dyn Reports>, DeviceError> {
    let refused =
        |error: hidapi::HidError| DeviceError::Refused { device, cause: error.to_string(), remedy: PLUG };
    let system = HidApi::new().map_err(refused)?;
    let (cause, remedy) = ("none is plugged in", PLUG);
    let found = system.device_list().find(|info| is_cap(info));
    let opened = found.ok_or(DeviceError::Unavailable { device, cause, remedy })?.open_device(&system);
    let opened = opened.map_err(refused)?;
    opened.set_blocking_mode(false).map_err(refused)?;
    Ok(Box::new(opened))
}

impl Reports for HidDevice {
    fn next(&mut self, report: &mut [u8]) -> Result<usize, Gone> {
        self.read(report).map_err(|_| Gone)
    }
}

fn is_cap(info: &DeviceInfo) -> bool {
    let maker = match info.vendor_id() {
        THREE_DCONNEXION => true,
        LOGITECH => LOGITECH_CAPS.contains(&info.product_id()),
        _ => false,
    };
    let usage = (info.usage_page(), info.usage());
    maker && (usage == (0, 0) || usage == (GENERIC_DESKTOP, MULTI_AXIS))
}
