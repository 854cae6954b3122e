//! How crowded the particles stand: an oracle of the density that knows nothing of the solvers.

use glam::{IVec3, Vec3};
use hapflow_fluid::{Kernel, ParticleView};
use std::collections::HashMap;

/// Support of the sum, in spacings.
const SUPPORT: f32 = 2.0;

/// For each particle the summed density over that of the lattice of `spacing` (m).
pub(super) fn fill(view: &ParticleView, spacing: f64) -> Vec<f64> {
    let reach = SUPPORT * spacing as f32;
    let kernel = Kernel::Wendland;
    let full = kernel.lattice_sum(spacing, f64::from(reach)) / spacing.powi(3);
    let at = |p: &[f32; 3]| Vec3::from(*p);
    let cell = |p: Vec3| (p / reach).floor().as_ivec3();
    let mut cells: HashMap<IVec3, Vec<Vec3>> = HashMap::new();
    view.positions.iter().for_each(|p| cells.entry(cell(at(p))).or_default().push(at(p)));
    let sum = |p: &[f32; 3]| {
        let (p, c) = (at(p), cell(at(p)));
        let around = (0..27).map(|k| c + IVec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        let near = around.filter_map(|c| cells.get(&c)).flatten();
        near.map(|q| kernel.value(f64::from(p.distance(*q)), f64::from(reach))).sum::<f64>() / full
    };
    view.positions.iter().map(sum).collect()
}

/// Energy that lies in the crowding, as a share of what fluid of twice its density holds by linear elasticity: the mean of the
/// squares of what is too much.
pub(super) fn squeeze(fill: &[f64]) -> f64 {
    fill.iter().map(|f| (f - 1.0).max(0.0).powi(2)).sum::<f64>() / fill.len().max(1) as f64
}
