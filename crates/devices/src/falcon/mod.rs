//! The Novint Falcon: three arms with a motor and an encoder each hold a grip, behind a serial line over USB.
//!
//! | part | here |
//! |---|---|
//! | lengths, angles, ratios | [`Geometry`], from a file or shipped |
//! | place, angles, torques | [`Kinematics`] |
//! | torques in motor counts | [`motor_counts`] |
//! | packets | [`Command`], [`Reply`], picked from a [`ByteStream`] |
//! | firmware image | [`Firmware`] |

mod firmware;
mod geometry;
mod kinematics;
mod motors;
mod packet;
mod stream;

pub use firmware::{Firmware, FirmwareError};
pub use geometry::{Geometry, GeometryError};
pub use kinematics::{Kinematics, PoseError};
pub use motors::{MAX_MOTOR_COUNTS, motor_counts, torques_of};
pub use packet::{Command, Leds, PACKET_BYTES, Reply};
pub use stream::ByteStream;
