//! What a hand needs: tool state, wrench, filters, device mapping and the safety gate.
//!
//! Pure and thread-free: everything here is called from one servo tick, and nothing here allocates, locks or
//! logs after it was built. SI units, f64, right-handed, y up.
//!
//! | need | here |
//! |---|---|
//! | smooth a force | [`Filter`], described by a [`FilterSpec`] |
//! | velocity of a device that gives positions only | [`VelocityEstimator`] |
//! | move a tool in a fluid and make a force of it | [`Coupling`], [`LocalModel`] |
//! | device frame to scene frame and back, a soft edge, a clutch | [`Mapping`], [`Rim`], [`Clutch`] |
//! | feel solids | [`Proxy`] among [`Solid`]s |
//! | let a force out to a hand | [`SafetyGate`], the only maker of a [`GatedWrench`] |
#![forbid(unsafe_code)]

mod added_mass;
mod axes;
mod clutch;
mod coupling;
mod fault;
mod filter;
mod forecast;
mod gate;
mod gate_settings;
mod gated_wrench;
mod immersion;
mod impact;
mod law;
mod local;
mod local_model;
mod mapping;
mod neighbourhood;
mod passivity;
mod proxy;
mod range;
mod rendering;
mod rim;
mod solid;
mod stability;
mod types;
mod velocity;

pub use axes::{Axes, AxesError};
pub use clutch::Clutch;
pub use coupling::{Answer, BodyState, Coupling, CouplingKind, Drive, FrameEnd};
pub use fault::FaultSet;
pub use filter::{
    DEFAULT_BUTTERWORTH_ORDER, DEFAULT_SERVO_RATE_HZ, FILTER_PRESETS, Filter, FilterError, FilterSpec,
    MAX_BUTTERWORTH_ORDER, MAX_TAPS, TapPlace, WindowKind,
};
pub use forecast::Forecast;
pub use gate::{MAX_TICK_S, ModelAge, SafetyGate};
pub use gate_settings::GateSettings;
pub use gated_wrench::GatedWrench;
pub use law::{Law, LawNode};
pub use local_model::LocalModel;
pub use mapping::Mapping;
pub use neighbourhood::{Neighbourhood, Parcel};
pub use proxy::{Contact, MAX_CONTACTS, Proxy, SolidFeel, Touching};
pub use range::{RangeError, check_range};
pub use rendering::Rendering;
pub use rim::{Rim, Workspace, WorkspaceError};
pub use solid::{Pose, Solid, SolidKind, SolidShape, ground, open_box};
pub use stability::{LOCAL_DELAYS_S, most_damping, most_stiffness};
pub use types::{ToolState, Wrench};
pub use velocity::VelocityEstimator;
