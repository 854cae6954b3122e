//! Devices behind their makers' libraries, which are loaded when such a device is asked for: nothing of them is needed to
//! build or to run without.
#![allow(unsafe_code)]

mod force_dimension;
mod library;
mod open_haptics;

pub use force_dimension::ForceDimension;
pub use open_haptics::OpenHaptics;
