//! The other side of the C interface. A library that claims it is loaded by name, and [`check`] puts it through its paces;
//! and a plugin ([`Extensions`]) brings a fluid, a device or a coupling, as the traits of hapflow have them.

mod check;
mod coupling;
mod device;
mod extension;
mod failure;
mod fluid_backend;
#[rustfmt::skip]
mod generated;
mod limits;
mod plugin;

pub use check::{Finding, check};
pub use coupling::PluginCoupling;
pub use device::PluginDevice;
pub use extension::{Extensions, find};
pub use fluid_backend::PluginFluid;
pub use plugin::{Plugin, PluginError};
