//! What the fluid costs: how fast it is, what accuracy costs, and what nobody pays for who does not use it.
//!
//! Everything that is compared is run side by side in one process, in turns, so that a busy machine is busy for both. Costs
//! are CPU time of all threads.

mod machine;
mod peers;
mod rig;
mod skip;
mod speed;
mod work_precision;

pub use crate::felt::{CostPoint, Crossing, Filtered, Found, Spectrum, felt, filters};
pub use machine::Machine;
pub use skip::{Saving, skip};
pub use speed::{Speed, speed};
pub use work_precision::{Point, work_precision};
