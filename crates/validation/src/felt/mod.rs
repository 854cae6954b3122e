//! The felt force in closed loop: a simulated device in a simulated hand, a servo, a coupling and a fluid, against the
//! truth, which is the hand's own path through a fluid that answers at once.

mod closed_loop;
mod crossing;
mod figures;
mod jet;
mod lag;
mod still;
mod truth;
mod ways;

use crate::Case;

/// The cases, in the order of the table.
pub(crate) const CASES: [Case; 3] = [still::CASE, crossing::CASE, lag::CASE];
