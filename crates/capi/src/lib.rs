//! The C ABI of hapflow. `include/hapflow/hapflow.h` is the contract; what stands here keeps it.
//!
//! A function of the header is a check, a conversion, one call of the engine, and a conversion back:
//!
//! | file | what |
//! |---|---|
//! | `library` | versions, texts of results, the last error |
//! | `session`, `servo`, `fluid` | the functions, by thread class |
//! | `config`, `tool_state`, `wrench`, `report` | the header's structs |
//! | `code` | results |
//! | `fence` | panics end here |
//! | `table`, `lane` | handles, and who may be where; the one static |
//! | `caller` | the caller's memory |
//!
//! `unsafe` is in `lane`, `caller` and, for one line a struct, where the header's structs are.

mod caller;
mod code;
mod config;
mod fence;
mod fluid;
mod hooks;
mod lane;
mod library;
mod report;
mod servo;
mod session;
mod table;
mod tool_state;
mod wrench;
