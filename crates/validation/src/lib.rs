//! The validation of the fluid: every force with a known answer, and what it costs to compute.
//!
//! A [`Case`] is a flow whose answer is known: a formula or published data. It runs at a spacing with its physical
//! parameters ([`Setup`]) and hands back what it measured ([`Measure`]). A [`Plan`] says which settings and which
//! spacings; [`Plan::run_case`] makes the rows ([`Row`]) of a case: error, goal, observed order, cost.
//!
//! One configuration serves all cases, the one that a scene gets when it says nothing; a row lists all that
//! differs from it.
#![forbid(unsafe_code)]

pub mod bench;
mod case;
mod cases;
mod error;
mod felt;
mod measure;
mod plan;
pub mod reference;
mod row;
mod run;
mod setup;
mod shortfalls;
pub mod stats;
pub mod stress;
mod worlds;

pub use case::{Case, Parameter};
pub use cases::{CASES, find};
pub use error::ValidationError;
pub use measure::{Felt, Measure, Target};
pub use plan::Plan;
pub use row::Row;
pub use setup::Setup;
pub use shortfalls::{Shortfall, shortfalls};
