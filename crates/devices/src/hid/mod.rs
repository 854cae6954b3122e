//! Human interface devices, which tell what a hand does and give no force.

mod motion_report;
mod reports;
mod space_mouse;
#[cfg(not(feature = "hid"))]
#[path = "no_system.rs"]
mod system;
#[cfg(feature = "hid")]
mod system;

pub use motion_report::MotionReport;
pub use reports::{Gone, Reports};
pub use space_mouse::SpaceMouse;
