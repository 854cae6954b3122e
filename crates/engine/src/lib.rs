//! The session: a scene goes in, a fluid runs, a hand moves in it at 1 kHz, and the force that it feels comes
//! out. The one meeting place of fluid, haptics, devices and threads.
//!
//! ```text
//!  main ── settings ──► fluid ── local model ──► servo ──► report ──► main
//!                         ▲                        │
//!                         └────── tool path ───────┘
//! ```
//!
//! [`Session::open`] makes a session of a [`Scene`] and gives its two halves: a [`ServoUnit`], ticked at about
//! 1 kHz by whoever owns the hand, and a [`FluidUnit`], which steps one fluid frame at a time. Who drives each
//! is chosen apart: the session's own threads, or the host. [`run`] drives both for a whole run, on a virtual
//! clock (deterministic, as fast as it goes) or in real time.
#![forbid(unsafe_code)]

mod builtin;
mod control;
mod error;
mod fluid_unit;
mod force_limit;
mod form;
mod mesh_file;
mod obstacles;
mod pace;
mod parts;
mod recorder;
mod recording;
pub mod run;
mod scene;
mod scene_builder;
mod scene_device;
mod scene_file;
mod servo;
mod session;
pub mod settings;
mod shared;
pub mod signal;
mod stability;
mod threads;
mod tick_times;
mod tool_lane;
mod touch;
mod value;

pub use builtin::{load, shipped};
pub use control::Control;
pub use error::SceneError;
pub use fluid_unit::{BodyReport, FluidReport, FluidUnit};
pub use form::{Form, FormKind};
pub use obstacles::ObstacleMover;
pub use pace::VirtualPace;
pub use parts::{BackendMaker, CouplingMaker, DeviceMaker, Parts};
pub use recorder::Recorded;
pub use recording::{Recording, Row, TickWriter};
pub use scene::{
    BackendKind, Change, DeviceKind, FalconSettings, FreeBody, MAX_BODIES, MAX_OBSTACLES, MAX_TOOLS,
    MappingSettings, MotionOrigin, Obstacle, PluginSettings, RunSettings, Scene, ToolSettings,
};
pub use scene_device::{open_device, open_device_on};
pub use scene_file::{parse, write};
pub use servo::{ServoReport, ServoUnit};
pub use session::{BodyList, Drive, Session, SessionOptions, open_backend};
pub use threads::{FluidPace, SERVO_PRIORITY, ServoPace};
pub use tick_times::TickTimes;
pub use value::Value;
