//! hapflow lets a hand feel a fluid. This crate gathers the rooms of the house under one roof.
#![forbid(unsafe_code)]

pub use hapflow_devices as devices;
pub use hapflow_engine as engine;
pub use hapflow_fluid as fluid;
pub use hapflow_haptics as haptics;
pub use hapflow_realtime as realtime;

/// The README's Rust is compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
