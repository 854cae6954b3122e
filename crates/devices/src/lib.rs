//! Haptic devices of hapflow, simulated and real.
//!
//! | device | moves | feels |
//! |---|---|---|
//! | [`NullDevice`] | not at all | nothing |
//! | [`Replay`] | along a recorded [`Motion`] | nothing |
//! | [`SimulatedHand`] | as a hand that follows a [`TargetScript`] | the force: it is a mass on a spring and damper |
//! | [`falcon::Falcon`] | as a hand moves it | the force |
//! | [`sdk::ForceDimension`], [`sdk::OpenHaptics`] | as a hand moves it | the force |
//! | [`hid::SpaceMouse`] | as its cap is deflected | nothing |
//!
//! All of them speak [`HapticDevice`]. SI units, f64, right-handed, y up. Reading and writing allocates
//! nothing; building a device may.
#![deny(unsafe_code)]

mod at_end;
mod device;
mod error;
pub mod falcon;
mod file;
mod hand;
mod hand_settings;
pub mod hid;
mod info;
mod mass;
mod motion;
mod motion_csv;
mod null;
mod path_point;
mod replay;
mod script;
pub mod sdk;

pub use at_end::AtEnd;
pub use device::{HapticDevice, Pacing};
pub use error::DeviceError;
pub use file::{read_at_most, read_text_at_most};
pub use hand::SimulatedHand;
pub use hand_settings::{HandPreset, HandSettings};
pub use info::{
    DeviceInfo, EMULATED_FALCON, FALCON, FORCE_DIMENSION, HAND, NULL, REPLAY, SPACE_MOUSE, TOUCH, find,
    first_present, list,
};
pub use motion::{Motion, MotionSample};
pub use motion_csv::{MAX_SAMPLES, MotionError};
pub use null::NullDevice;
pub use path_point::PathPoint;
pub use replay::Replay;
pub use script::{ScriptError, Segment, TargetScript};
