//! The other side of the C interface: a library that claims it is loaded by name, and [`check`] puts it through its paces.

mod check;
#[rustfmt::skip]
mod generated;
mod plugin;

pub use check::{Finding, check};
pub use plugin::{Plugin, PluginError};
