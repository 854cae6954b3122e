//! The felt force in closed loop: a simulated device in a simulated hand, a servo, a coupling and a fluid, against the
//! truth, which is the hand's own path through a fluid that answers at once.

mod bench;
mod closed_loop;
mod compare;
mod crossing;
mod energy;
mod entry;
mod figures;
mod filters;
mod jet;
mod lag;
mod pool;
mod release;
mod spectrum;
mod still;
mod stir;
mod ticks;
mod truth;
mod ways;

pub(crate) use closed_loop::ClosedLoop;
pub use compare::{Crossing, Found, Point as CostPoint, felt};
pub use filters::{Filtered, filters};
pub use spectrum::Spectrum;

use crate::Case;

/// The cases, in the order of the table.
pub(crate) const CASES: [Case; 8] = [
    still::CASE,
    crossing::CASE,
    lag::CASE,
    entry::CASE,
    stir::CASE,
    release::POOL,
    release::JET,
    energy::CASE,
];
