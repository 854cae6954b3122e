//! What the tests of the C interface share: building libhapflow, compiling C, and the library's functions.
#![allow(dead_code, unused_imports)]

mod api;
mod bridge;
mod build;
pub mod header;
mod random;

pub use api::{
    Api, BodyConfig, BodyReport, Contact, Device, DeviceConfig, DeviceInfo, ObstacleConfig, Report, Scene,
    SceneInfo, ServoPace, Session, SessionConfig, SettingInfo, SourceConfig, ToolConfig, ToolState, Wrench,
    made, shown,
};
pub use bridge::Bridge;
pub use build::{Variant, compile, library, root, scratch};
pub use random::Random;

/// Results by name, as the header has them.
pub mod code {
    pub const OK: i32 = 0;
    pub const FORCE_HELD: i32 = 1;
    pub const NO_TIME: i32 = 2;
    pub const LATE: i32 = 3;
    pub const MORE: i32 = 4;
    pub const PANIC: i32 = -1;
    pub const NOT_NEGOTIATED: i32 = -2;
    pub const VERSION: i32 = -3;
    pub const NULL: i32 = -4;
    pub const HANDLE: i32 = -5;
    pub const BUSY: i32 = -6;
    pub const FULL: i32 = -7;
    pub const STRUCT: i32 = -8;
    pub const UNSUPPORTED: i32 = -9;
    pub const TEXT: i32 = -10;
    pub const SCENE: i32 = -11;
    pub const NOT_FOUND: i32 = -12;
    pub const SETTING: i32 = -13;
    pub const VALUE: i32 = -14;
    pub const FIXED: i32 = -15;
    pub const NOT_FINITE: i32 = -16;
    pub const ORIENTATION: i32 = -17;
    pub const TIME: i32 = -18;
    pub const FAULTED: i32 = -19;
    pub const INDEX: i32 = -20;
    pub const DRIVE: i32 = -21;
    pub const DEVICE: i32 = -22;
    pub const FILE: i32 = -23;
    pub const RECORDING: i32 = -24;
}

/// `hapflow_session_config.fluid_drive` or `.servo_drive`: the session drives that half itself.
pub const DRIVE_OWNED: u32 = 1;

/// A jet in closed form on a ball at rest: a force at no cost.
pub const JET: &str = r#"
[run]
duration = 0.2
fluid_hz = 100
backend = "analytic-jet"
device = "null"
[bounds]
min = [-0.1, -0.12, -0.1]
max = [0.1, 0.12, 0.1]
[[source]]
name = "tap"
position = [0.0, 0.05, 0.0]
diameter = 0.02
speed = 1.5
[gate]
ramp_in = 0.02
"#;

/// To be put behind [`JET`]: a second jet, with a second tool in it.
pub const SECOND: &str = r#"
[[source]]
name = "right"
position = [0.06, 0.05, 0.0]
diameter = 0.02
speed = 1.0
[[tool]]
[[tool]]
name = "second"
position = [0.06, 0.0, 0.0]
"#;

/// To be put behind [`JET`]: a plate over the tool, in the jet.
pub const PLATE: &str = r#"
[[obstacle]]
name = "plate"
shape = "disc"
radius = 0.04
thickness = 0.008
position = [0.0, 0.028, 0.0]
"#;
