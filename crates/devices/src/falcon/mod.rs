//! The Novint Falcon: three arms with a motor and an encoder each hold a grip, behind a serial line over USB.
//!
//! | part | here |
//! |---|---|
//! | lengths, angles, ratios | [`Geometry`], from a file or shipped |
//! | place, angles, torques | [`Kinematics`] |
//! | torques in motor counts | [`motor_counts`] |
//! | packets | [`Command`], [`Reply`], picked from a [`ByteStream`] |
//! | firmware image | [`Firmware`] |
//! | USB, real or emulated | [`Transport`] |
//! | a Falcon that is not there | [`EmulatedFalcon`] |
//! | the device | [`Falcon`] |
//! | what one unit's zero angles and strength are | [`zeros`], [`strength`] |

mod boot;
mod calibration;
mod driver;
mod emulation;
mod error;
mod exchange;
mod firmware;
mod geometry;
mod kinematics;
mod measuring;
mod motors;
mod packet;
mod serial;
mod stream;
mod transport;
#[cfg(feature = "falcon")]
mod usb;
#[cfg(not(feature = "falcon"))]
#[path = "no_usb.rs"]
mod usb;

pub use calibration::{
    CalibrationError, LARGEST_LOAD_KG, LEAST_LOAD_KG, LoadReading, PlaceReading, Strength, Zeros, strength,
    zeros,
};
pub use driver::{Falcon, FalconOptions, FalconStats};
pub use emulation::{EmulatedFalcon, EmulatedHand, EmulatedTransport, Trouble};
pub use error::{FalconError, Stage, UDEV_RULE, UDEV_RULE_FILE};
pub use firmware::{Firmware, FirmwareError};
pub use geometry::{Geometry, GeometryError};
pub use kinematics::{FREE_DISCS, Kinematics, PoseError};
pub use measuring::{Ask, Request};
pub use motors::{MAX_MOTOR_COUNTS, motor_counts, torques_of};
pub use packet::{Command, Leds, PACKET_BYTES, Reply};
pub use stream::ByteStream;
pub use transport::{LinkError, PluggedIn, Transport, USB_PACKET_BYTES};
pub use usb::{open, plugged_in};
