//! Steepest descent onto pressures that only push, accelerated.
//!
//! Both solves ask for unknowns p ≥ 0 that leave nothing over where p > 0 and nothing too much where p = 0. The sums of
//! pressure and of divergence are each other's transpose, so that this is the least of a convex square, and what is
//! left over its slope. Each iteration is the one of DFSPH, p ← max(0, p + what is left × relief), taken from a point
//! ahead (Nesterov 1983, "A method of solving a convex programming problem with convergence rate O(1/k²)"), which needs
//! the square root of the iterations. It starts anew where it would climb (O'Donoghue & Candès 2015,
//! doi:10.1007/s10208-013-9150-3). Sums over particles are taken in order.

use crate::solver::dfsph::site::Site;

/// The last unknowns, and how far ahead the next step begins.
#[derive(Clone, Debug, Default)]
pub(super) struct Descent {
    last: Vec<f32>,
    momentum: f32,
}

impl Descent {
    /// Starts at `at`.
    pub fn begin(&mut self, at: &[f32]) {
        self.last.clear();
        self.last.extend_from_slice(at);
        self.momentum = 1.0;
    }

    /// One iteration: `at` is the point ahead at which `left` was found, and becomes the next; none is larger than `most`.
    pub fn advance(
        &mut self,
        at: &mut [f32],
        sites: &[Site],
        (scale, most): (f32, f32),
        left: impl Fn(usize) -> f32,
    ) {
        let mut climb = 0.0_f64;
        for (i, site) in sites.iter().enumerate() {
            let next = (at[i] + left(i) * site.relief * scale).clamp(0.0, most);
            climb -= f64::from(left(i) * (next - self.last[i]));
            at[i] = next;
        }
        let before = if climb > 0.0 { 1.0 } else { self.momentum };
        self.momentum = 0.5 * (1.0 + (1.0 + 4.0 * before * before).sqrt());
        let ahead = (before - 1.0) / self.momentum;
        for (at, last) in at.iter_mut().zip(&mut self.last).take(sites.len()) {
            let next = *at;
            *at = (next + ahead * (next - *last)).clamp(0.0, most);
            *last = next;
        }
    }

    /// Gives back where it started.
    pub fn restore(&self, at: &mut [f32]) {
        at.copy_from_slice(&self.last);
    }
}

/// Mean of what is left over, counting what is too little only where there is something to take back. A mean and no root of
/// squares: a pressure that is too low all through a deep pool leaves a little everywhere, where what it has to answer
/// is much in a thin layer, so that a share of this mean is about the same share of the pressure at any spacing.
pub(super) fn violation(at: &[f32], sites: &[Site], left: impl Fn(usize) -> f32) -> f32 {
    let (mut sum, mut count) = (0.0_f64, 0_u32);
    for i in (0..sites.len()).filter(|&i| sites[i].relief > 0.0) {
        let r = left(i);
        sum += if at[i] > 0.0 || r > 0.0 { f64::from(r.abs()) } else { 0.0 };
        count += 1;
    }
    (sum / f64::from(count.max(1))) as f32
}
