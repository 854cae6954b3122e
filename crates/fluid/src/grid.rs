//! Uniform grid with cell side = kernel support; particles sorted by cell with a stable counting sort.
//!
//! Cells run along x first, so the three neighbours of a cell in x are one range of particles, and the
//! neighbours of a particle are nine ranges. One empty layer of cells all round saves every edge test.

use crate::particles::Particles;
use std::ops::Range;

/// Most cells; a wider spread of particles gets larger cells.
const MAX_CELLS: f32 = 4e6;

#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    inverse_cell: f32,
    origin: [f32; 3],
    dims: [usize; 3],
    /// First particle of each cell, and the end of the last.
    start: Vec<u32>,
    /// Cell of each particle, before and after the sort.
    unsorted: Vec<u32>,
    cell: Vec<u32>,
    /// Where each particle stood before the last sort.
    pub order: Vec<u32>,
}

impl Grid {
    /// Sorts `particles` by cell and drops those for which `dead` holds.
    pub fn sort(&mut self, particles: &mut Particles, support: f32, dead: &[bool]) {
        self.lay_out(particles, support, dead);
        let cells = self.dims.iter().product::<usize>();
        // Counted two places on: the sums then stand one on, and the scatter moves each to its own place.
        self.start.clear();
        self.start.resize(cells + 2, 0);
        self.unsorted.clear();
        for (i, &dead) in dead.iter().enumerate().take(particles.len()) {
            let cell = if dead { u32::MAX } else { self.cell_at(particles, i) };
            self.unsorted.push(cell);
            if cell != u32::MAX {
                self.start[cell as usize + 2] += 1;
            }
        }
        let mut sum = 0;
        for count in &mut self.start {
            sum += *count;
            *count = sum;
        }
        self.scatter(sum as usize);
        particles.permute(&self.order);
    }

    /// Stable: particles of one cell keep their order, so the result never depends on threads.
    fn scatter(&mut self, kept: usize) {
        self.order.resize(kept, 0);
        self.cell.resize(kept, 0);
        for (i, &cell) in self.unsorted.iter().enumerate() {
            if cell != u32::MAX {
                let slot = &mut self.start[cell as usize + 1];
                self.order[*slot as usize] = i as u32;
                self.cell[*slot as usize] = cell;
                *slot += 1;
            }
        }
    }

    fn lay_out(&mut self, p: &Particles, support: f32, dead: &[bool]) {
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for i in (0..p.len()).filter(|&i| !dead[i]) {
            for (axis, value) in [p.x[i], p.y[i], p.z[i]].into_iter().enumerate() {
                low[axis] = low[axis].min(value);
                high[axis] = high[axis].max(value);
            }
        }
        if low[0] > high[0] {
            (low, high) = ([0.0; 3], [0.0; 3]);
        }
        let mut cell = support;
        let count = |cell: f32| (0..3).map(|a| (high[a] - low[a]) / cell + 3.0).product::<f32>();
        while count(cell) > MAX_CELLS {
            cell *= 1.3;
        }
        self.inverse_cell = 1.0 / cell;
        self.origin = low.map(|l| l - cell);
        self.dims = std::array::from_fn(|a| ((high[a] - low[a]) / cell) as usize + 3);
    }

    fn cell_at(&self, p: &Particles, i: usize) -> u32 {
        let along = |value: f32, axis: usize| {
            let k = ((value - self.origin[axis]) * self.inverse_cell) as usize;
            k.clamp(1, self.dims[axis] - 2)
        };
        let (x, y, z) = (along(p.x[i], 0), along(p.y[i], 1), along(p.z[i], 2));
        ((z * self.dims[1] + y) * self.dims[0] + x) as u32
    }

    /// The nine ranges of particles that may touch particle `i`, itself included.
    #[inline]
    pub fn neighbours(&self, i: usize) -> [Range<usize>; 9] {
        let cell = self.cell[i] as usize;
        let (nx, plane) = (self.dims[0], self.dims[0] * self.dims[1]);
        std::array::from_fn(|k| {
            let row = cell - plane - nx + (k / 3) * plane + (k % 3) * nx;
            self.start[row - 1] as usize..self.start[row + 2] as usize
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particles::Newborn;
    use glam::Vec3;

    fn cloud(n: usize, size: f32) -> Particles {
        let mut seed = 12345_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1664525).wrapping_add(1013904223);
            (seed >> 8) as f32 / (1 << 24) as f32 * size
        };
        let born: Vec<_> = (0..n)
            .map(|_| Newborn { position: Vec3::new(random(), random(), random()), ..Newborn::default() })
            .collect();
        let mut p = Particles::new();
        p.extend(&born);
        p
    }

    #[test]
    fn ranges_hold_every_neighbour_once() {
        for size in [0.05, 0.5, 3.0] {
            let (support, mut p, mut grid) = (0.1, cloud(300, size), Grid::default());
            grid.sort(&mut p, support, &vec![false; 300]);
            for i in 0..p.len() {
                let seen: Vec<usize> = grid.neighbours(i).into_iter().flatten().collect();
                let mut unique = seen.clone();
                unique.dedup();
                assert_eq!(seen.len(), unique.len());
                for j in 0..p.len() {
                    if p.position(i).distance(p.position(j)) <= support {
                        assert!(seen.contains(&j), "{i} misses {j} at size {size}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_dead_are_dropped() {
        let (mut p, mut grid) = (cloud(10, 1.0), Grid::default());
        let dead: Vec<bool> = (0..10).map(|i| i % 2 == 0).collect();
        grid.sort(&mut p, 0.1, &dead);
        assert_eq!(p.len(), 5);
        assert!(p.id[..5].iter().all(|id| id % 2 == 1));
        grid.sort(&mut p, 0.1, &[true; 5]);
        assert_eq!(p.len(), 0);
    }

    #[test]
    fn a_wide_spread_stays_within_memory() {
        let mut p = Particles::new();
        let at = |x: f32| Newborn { position: Vec3::splat(x), ..Newborn::default() };
        p.extend(&[at(-500.0), at(500.0)]);
        let mut grid = Grid::default();
        grid.sort(&mut p, 0.01, &[false, false]);
        assert!(grid.start.len() < 10_000_000);
    }
}
