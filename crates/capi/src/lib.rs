//! The C ABI of hapflow. `include/hapflow/` is the contract; what stands here keeps it.
//!
//! A function of the header is a check, a conversion, one call of the engine, and a conversion back:
//!
//! | file | what |
//! |---|---|
//! | `library` | versions, texts of results, the last error |
//! | `session`, `servo`, `fluid`, `obstacle` | the functions of a session, by thread class |
//! | `recording` | those of a recording |
//! | `scene` | those of a scene that is built by calls |
//! | `device` | those of a device in a loop of the host |
//! | `log` | what a session has to say, told to the host |
//! | `extension`, `absent_device`, `absent_log` | optional parts, as tables; and a build without them |
//! | `config`, `contact`, `device_config`, `tool_state`, `wrench`, `report`, `servo_pace`, `setting_info` | the header's structs |
//! | `source_config`, `obstacle_config`, `tool_config`; `part` | a scene's parts, and what they have in common |
//! | `scene_source` | what the two configurations have in common |
//! | `build_info`, `catalog` | what the build has; shipped scenes and devices |
//! | `code` | results |
//! | `generated`, `contract` | the header in Rust, and the check that all this is as it says |
//! | `fence` | panics end here |
//! | `handle`, `table`, `device_table`, `scene_table` | handles, and who may be where; the statics |
//! | `caller` | the caller's memory |
//!
//! `unsafe` is in `caller` and, for one line a struct, where the header's structs are.

// What only an absent part would use is left out by the linker.
#![cfg_attr(not(all(feature = "device", feature = "log")), allow(dead_code))]

mod body;
mod body_config;
mod build_info;
mod caller;
mod catalog;
mod code;
mod config;
mod contact;
mod contract;
#[cfg(feature = "device")]
mod device;
#[cfg(not(feature = "device"))]
#[path = "absent_device.rs"]
mod device;
mod device_config;
#[cfg(feature = "device")]
mod device_table;
mod extension;
mod fence;
mod fluid;
#[rustfmt::skip]
mod generated;
mod handle;
mod hooks;
mod library;
#[cfg(feature = "log")]
mod log;
#[cfg(not(feature = "log"))]
#[path = "absent_log.rs"]
mod log;
mod obstacle;
mod obstacle_config;
mod part;
mod recording;
mod report;
mod scene;
mod scene_source;
mod scene_table;
mod servo;
mod servo_pace;
mod session;
mod setting_info;
mod source_config;
mod table;
mod tool_config;
mod tool_state;
mod wrench;
