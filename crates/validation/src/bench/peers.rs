//! What other codes were measured at on the same cases, with the date: SPlisHSPlasH 2.19.0 (its Python wheel) and salva3d
//! 0.11.0, on two cores of a shared Xeon. The tank of the case `buoyancy` and the column of `dam-break`, particles on the same
//! lattice; support two spacings, cubic spline, walls of one layer of samples. Costs are process CPU time.

/// A figure of a peer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Figure {
    pub case: &'static str,
    pub who: &'static str,
    pub particles: usize,
    /// Relative error of the force, or lead of the front in units of the case.
    pub error: f64,
    /// CPU time for a simulated second, s.
    pub cost: f64,
    pub date: &'static str,
}

const fn figure(case: &'static str, who: &'static str, particles: usize, error: f64, cost: f64) -> Figure {
    Figure { case, who, particles, error, cost, date: "2026-11-23" }
}

const FIGURES: [Figure; 13] = [
    figure("buoyancy", "SPlisHSPlasH DFSPH 0.05 %", 10_216, 0.059, 30.0),
    figure("buoyancy", "SPlisHSPlasH DFSPH 0.05 %", 28_650, 0.046, 137.0),
    figure("buoyancy", "SPlisHSPlasH DFSPH 0.01 %", 10_216, 0.061, 86.0),
    figure("buoyancy", "SPlisHSPlasH IISPH 0.05 %", 10_216, 0.089, 66.0),
    figure("buoyancy", "SPlisHSPlasH WCSPH", 10_216, 0.154, 103.0),
    figure("buoyancy", "SPlisHSPlasH WCSPH", 28_650, 0.113, 372.0),
    figure("buoyancy", "SPlisHSPlasH PBF", 10_216, 0.104, 128.0),
    figure("buoyancy", "salva DFSPH 0.05 %", 10_216, 0.045, 127.0),
    figure("buoyancy", "salva IISPH 0.05 %", 10_216, 0.059, 242.0),
    // Step costs over their fixed steps: 71, 27.9 and 126 ms on two threads, 207 ms on one.
    figure("dam-break", "SPlisHSPlasH DFSPH 0.05 %", 10_976, 0.125, 71.0 / 2.23),
    figure("dam-break", "SPlisHSPlasH WCSPH", 10_976, 0.102, 27.9 / 0.228),
    figure("dam-break", "SPlisHSPlasH IISPH 0.05 %", 10_976, 0.121, 126.0 / 2.23),
    figure("dam-break", "salva DFSPH 0.05 %", 10_976, 0.168, 207.0 / 2.23),
];

/// All of them.
pub(super) fn figures() -> impl Iterator<Item = &'static Figure> {
    FIGURES.iter()
}
