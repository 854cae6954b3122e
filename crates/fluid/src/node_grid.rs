//! Places at which a field is tabulated, alike in all directions, and what lies between them.

use glam::{UVec3, Vec3};

/// A box of nodes. An axis of one node says that the field does not change along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NodeGrid {
    /// The first node, m.
    pub low: Vec3,
    /// Distance of neighbours, m.
    pub step: f32,
    /// Nodes along each axis, at least one.
    pub count: UVec3,
}

impl NodeGrid {
    /// From `low` to `high` or just beyond.
    pub fn spanning(low: Vec3, high: Vec3, step: f32) -> Self {
        Self { low, step, count: ((high - low).max(Vec3::ZERO) / step).ceil().as_uvec3() + 1 }
    }

    /// With `margin` more nodes on all sides.
    pub fn widened(&self, margin: u32) -> Self {
        let low = self.low - margin as f32 * self.step;
        Self { low, step: self.step, count: self.count + 2 * margin }
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.count.to_array().iter().map(|&n| n as usize).product()
    }

    /// The last node, m.
    pub fn high(&self) -> Vec3 {
        self.low + (self.count - 1).as_vec3() * self.step
    }

    /// Number of a node.
    pub fn index(&self, k: UVec3) -> usize {
        ((k.x * self.count.y + k.y) * self.count.z + k.z) as usize
    }

    /// Node of a number.
    pub fn node(&self, index: usize) -> UVec3 {
        let (y, z) = (self.count.y as usize, self.count.z as usize);
        UVec3::new((index / (y * z)) as u32, (index / z % y) as u32, (index % z) as u32)
    }

    /// Where a node is, m.
    pub fn place(&self, k: UVec3) -> Vec3 {
        self.low + k.as_vec3() * self.step
    }

    /// The nodes round `point` and their shares; outside, those of the nearest place within.
    pub fn blend(&self, point: Vec3) -> impl Iterator<Item = (usize, f32)> {
        let last = (self.count - 1).as_vec3();
        let u = ((point - self.low) / self.step).clamp(Vec3::ZERO, last);
        let cell = u.floor().min((last - 1.0).max(Vec3::ZERO));
        let (w, first) = (u - cell, self.index(cell.as_uvec3()));
        let next = UVec3::ONE.min(self.count - 1);
        (0..8_u32).filter_map(move |corner| {
            let bits = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
            let b = bits.as_vec3();
            let share = (b * w + (1.0 - b) * (1.0 - w)).element_product();
            let offset = bits * next;
            let index = first + ((offset.x * self.count.y + offset.y) * self.count.z + offset.z) as usize;
            (share > 0.0).then_some((index, share))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_field_is_met_exactly_and_holds_at_its_ends() {
        let grid = NodeGrid::spanning(Vec3::splat(-1.0), Vec3::new(1.0, 0.5, -1.0), 0.25);
        assert_eq!(grid.count, UVec3::new(9, 7, 1));
        let field: Vec<_> =
            (0..grid.len()).map(|i| grid.place(grid.node(i)).dot(Vec3::new(1.0, 2.0, 0.0))).collect();
        let at = |p: Vec3| grid.blend(p).map(|(i, share)| share * field[i]).sum::<f32>();
        assert!((at(Vec3::new(0.3, -0.2, 7.0)) + 0.1).abs() < 1e-5);
        assert!((at(Vec3::new(3.0, 0.5, -1.0)) - 2.0).abs() < 1e-5);
        assert!((at(grid.high()) - 2.0).abs() < 1e-5);
    }
}
