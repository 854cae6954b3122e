//! Human interface devices, which tell what a hand does and give no force.

mod motion_report;
#[cfg(feature = "hid")]
mod reports;
#[cfg(not(feature = "hid"))]
#[path = "no_reports.rs"]
mod reports;
mod space_mouse;

pub use motion_report::MotionReport;
pub use space_mouse::SpaceMouse;
