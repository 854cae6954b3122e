//! The fluid round a place, in small: how full and how fast it is at the nodes of a cubic lattice.

use crate::particles::Particles;
use glam::{DVec3, Vec3};

/// Nodes along an edge of the lattice.
const SIDE: usize = 16;

/// What is round a place: made on request, beside the steps, for who renders the fluid between its frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Surroundings {
    /// Place of the first node, m.
    pub origin: DVec3,
    /// Distance between nodes, m.
    pub spacing: f64,
    /// At each node the share that fluid fills, and three times that share times the velocity, m/s: x first, then y, z.
    nodes: Vec<[f32; 4]>,
}

impl Default for Surroundings {
    /// Empty; the first look takes all the memory that it will ever need.
    fn default() -> Self {
        Self { origin: DVec3::ZERO, spacing: 1.0, nodes: Vec::new() }
    }
}

impl Surroundings {
    /// Nodes along an edge.
    pub const SIDE: usize = SIDE;

    /// All nodes, x running first, then y, z: fill, and velocity times fill.
    pub fn nodes(&self) -> &[[f32; 4]] {
        &self.nodes
    }

    /// Where node `k` is, m.
    pub fn place(&self, k: usize) -> DVec3 {
        let [x, y, z] = [k % SIDE, k / SIDE % SIDE, k / (SIDE * SIDE)];
        self.origin + self.spacing * DVec3::new(x as f64, y as f64, z as f64)
    }

    /// Makes it an empty lattice that reaches `reach` metres to all sides of `around`.
    pub(crate) fn lay(&mut self, around: DVec3, reach: f64) {
        self.spacing = 2.0 * reach / (SIDE - 1) as f64;
        self.origin = around - reach;
        self.nodes.clear();
        self.nodes.resize(SIDE * SIDE * SIDE, [0.0; 4]);
    }

    /// Takes the particles of `volume` (m³) each: each goes to the eight nodes round it.
    pub(crate) fn take(&mut self, particles: &Particles, volume: f64) {
        let (inverse, origin) = (1.0 / self.spacing as f32, self.origin.as_vec3());
        let share = (volume / self.spacing.powi(3)) as f32;
        for i in 0..particles.len() {
            let at = (particles.position(i) - origin) * inverse;
            let last = (SIDE - 1) as f32;
            if at.min_element() >= 0.0 && at.max_element() < last && !particles.is_image(i) {
                self.spread(at, particles.velocity(i), share);
            }
        }
    }

    /// Sets node `k`.
    pub(crate) fn set(&mut self, k: usize, fill: f64, velocity: DVec3) {
        let [x, y, z] = (velocity * fill).as_vec3().to_array();
        self.nodes[k] = [fill as f32, x, y, z];
    }

    fn spread(&mut self, at: Vec3, velocity: Vec3, share: f32) {
        let (cell, rest) = (at.floor(), at - at.floor());
        let first = (cell.z as usize * SIDE + cell.y as usize) * SIDE + cell.x as usize;
        for corner in 0..8 {
            let [dx, dy, dz] = [corner & 1, corner >> 1 & 1, corner >> 2];
            let weight = |d: usize, r: f32| if d == 1 { r } else { 1.0 - r };
            let w = share * weight(dx, rest.x) * weight(dy, rest.y) * weight(dz, rest.z);
            let node = &mut self.nodes[first + (dz * SIDE + dy) * SIDE + dx];
            for (to, from) in node.iter_mut().zip([1.0, velocity.x, velocity.y, velocity.z]) {
                *to += w * from;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particles::Newborn;

    /// A lattice of particles fills the nodes within it, and moves them as it moves; nothing is lost between nodes.
    #[test]
    fn a_block_of_fluid_fills_and_moves() {
        let dx = 0.004;
        let velocity = Vec3::new(0.3, -1.0, 0.2);
        let born: Vec<_> = (0..8000)
            .map(|k| [k % 20, k / 20 % 20, k / 400].map(|c| (c as f32 - 9.7) * dx as f32))
            .map(|p| Newborn { position: p.into(), velocity, ..Newborn::default() })
            .collect();
        let mut particles = Particles::new();
        particles.extend(&born);
        let mut around = Surroundings::default();
        around.lay(DVec3::ZERO, 0.06);
        around.take(&particles, dx * dx * dx);
        let (mut volume, cell) = (0.0, around.spacing.powi(3));
        for (k, [fill, x, y, z]) in around.nodes().iter().enumerate() {
            volume += f64::from(*fill) * cell;
            if around.place(k).abs().max_element() < 0.025 {
                assert!((fill - 1.0).abs() < 0.1, "{fill}");
                assert!((Vec3::new(*x, *y, *z) / *fill - velocity).length() < 1e-4);
            }
        }
        assert!((volume / (8000.0 * dx * dx * dx) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn what_is_outside_is_left_out() {
        let mut particles = Particles::new();
        particles.extend(&[Newborn { position: Vec3::splat(0.5), ..Newborn::default() }]);
        let mut around = Surroundings::default();
        around.lay(DVec3::ZERO, 0.06);
        around.take(&particles, 1e-6);
        assert!(around.nodes().iter().all(|n| *n == [0.0; 4]));
    }
}
