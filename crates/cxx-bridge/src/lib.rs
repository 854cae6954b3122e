//! Sessions of the C ABI for C++ by [cxx](https://cxx.rs): `libhapflow_cxx`, a library beside the one `libhapflow` of the
//! process, whose functions it calls and whose handles it takes. `cpp/include/hapflow/cxx.hpp` is the C++ on top of it.
//!
//! Every bridged function gives a `Result` and ends its panics itself (`fence`). Those of class \[servo\] allocate
//! nothing, also when the tick is refused: a refusal is their value.

mod fence;
// The bindings are those that crates/capi compares with the header.
#[rustfmt::skip]
#[path = "../../capi/src/generated.rs"]
mod generated;
mod session;

use session::{Session, open, share};

/// What C++ sees. `tools/bridge.sh` makes `cpp/cxx/` of this file.
#[cxx::bridge(namespace = "hapflow::bridge")]
mod ffi {
    /// How a session is made: see `hapflow_session_config`. Texts that are empty are not given.
    struct Config<'a> {
        scene: &'a str,
        toml: &'a str,
        settings: &'a str,
        /// Handle of a scene that was built by calls, or 0.
        built: u64,
        threads: u32,
        fluid_drive: u32,
        record: bool,
    }

    #[namespace = ""]
    unsafe extern "C++" {
        include!("hapflow/hapflow.h");
        type hapflow_tool_state = crate::generated::hapflow_tool_state;
        type hapflow_wrench = crate::generated::hapflow_wrench;
        type hapflow_report = crate::generated::hapflow_report;
    }

    extern "Rust" {
        type Session;

        fn open(config: &Config) -> Result<Box<Session>>;
        fn share(handle: u64) -> Result<Box<Session>>;
        fn handle(self: &Session) -> Result<u64>;
        fn destroy(self: &Session) -> Result<()>;

        fn tick(self: &Session, state: &hapflow_tool_state, wrench: &mut hapflow_wrench) -> Result<i32>;
        fn emergency_stop(self: &Session) -> Result<i32>;
        fn clear_faults(self: &Session) -> Result<i32>;
        fn limit_force(self: &Session, max_force: f64, max_torque: f64) -> Result<i32>;
        fn move_obstacle(
            self: &Session,
            index: u32,
            position: &[f64; 3],
            orientation: &[f64; 4],
        ) -> Result<i32>;
        fn publish_obstacles(self: &Session) -> Result<i32>;

        fn fluid_advance(self: &Session, time_s: f64) -> Result<()>;
        fn fluid_step(self: &Session, end_s: f64) -> Result<()>;
        fn particles(self: &Session, positions: &mut [f32]) -> Result<usize>;

        fn tool_count(self: &Session) -> Result<u32>;
        fn obstacle_count(self: &Session) -> Result<u32>;
        fn latest_particles(self: &Session, positions: &mut [f32]) -> Result<usize>;
        fn report(self: &Session, tool: u32, report: &mut hapflow_report) -> Result<()>;
        fn set_number(self: &Session, path: &str, value: f64) -> Result<()>;
        fn set_text(self: &Session, path: &str, value: &str) -> Result<()>;
        fn get_number(self: &Session, path: &str) -> Result<f64>;
        fn get_text(self: &Session, path: &str) -> Result<String>;
    }
}
