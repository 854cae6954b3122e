//! Sorts the particles into upright columns three spacings wide, and in each column by height.
//!
//! Runs of sixteen then lie close together (after Páll & Hess 2013, doi:10.1016/j.cpc.2013.06.003), and what lies between two
//! heights of a column is one range. In columns of two spacings runs of eight are more compact, but a third of a falling jet's
//! time went into looking through them. Stable counting sort, so that nothing depends on threads.

use crate::particles::Particles;
use glam::Vec3;
use std::ops::Range;

/// Most cells; a wider spread of particles gets larger cells.
const MAX_CELLS: f32 = 4e6;
/// Side of a column, in spacings.
const WIDTH: f32 = 3.0;
/// Height of a cell, in supports.
const HEIGHT: f32 = 0.5;

#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    /// Width (x and z) of a cell, m.
    width: f32,
    /// 1/side of a cell along x, y, z, 1/m.
    inverse: [f32; 3],
    origin: [f32; 3],
    /// Corners of the box round all particles, m.
    pub corners: [Vec3; 2],
    /// Cells along x, y, z.
    dims: [usize; 3],
    /// First particle of each cell, and the end of the last. Cells run along y first, then x.
    start: Vec<u32>,
    /// Cell of each particle before the sort.
    cell: Vec<u32>,
    /// Where each particle stood before the last sort.
    pub order: Vec<u32>,
}

impl Grid {
    /// Sorts `particles` and drops those for which `dead` holds.
    pub fn sort(&mut self, particles: &mut Particles, spacing: f32, support: f32, dead: &[bool]) {
        self.lay_out(particles, spacing, support, dead);
        let cells = self.dims.iter().product::<usize>();
        // Counted two places on: the sums then stand one on, and the scatter moves each to its own place.
        self.start.clear();
        self.start.resize(cells + 2, 0);
        self.cell.clear();
        for (i, &dead) in dead.iter().enumerate().take(particles.len()) {
            let cell = if dead { u32::MAX } else { self.cell_at(particles, i) };
            self.cell.push(cell);
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
        self.order_by_height(&particles.y);
        particles.permute(&self.order);
    }

    /// Puts each particle into its cell.
    fn scatter(&mut self, kept: usize) {
        self.order.resize(kept, 0);
        for (i, &cell) in self.cell.iter().enumerate() {
            if cell != u32::MAX {
                let slot = &mut self.start[cell as usize + 1];
                self.order[*slot as usize] = i as u32;
                *slot += 1;
            }
        }
    }

    /// Orders each cell from the lowest up, by insertion: since the last time few have changed places.
    fn order_by_height(&mut self, y: &[f32]) {
        for next in 1..self.order.len() {
            let i = self.order[next] as usize;
            let mut k = next;
            while k > 0 {
                let before = self.order[k - 1] as usize;
                if self.cell[before] != self.cell[i] || y[before] <= y[i] {
                    break;
                }
                self.order[k] = before as u32;
                k -= 1;
            }
            self.order[k] = i as u32;
        }
    }

    fn lay_out(&mut self, p: &Particles, spacing: f32, support: f32, dead: &[bool]) {
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
        let mut side = [WIDTH * spacing, HEIGHT * support, WIDTH * spacing];
        let cells = |side: [f32; 3], axis: usize| (high[axis] - low[axis]) / side[axis] + 1.0;
        while (0..3).map(|a| cells(side, a)).product::<f32>() > MAX_CELLS {
            side = side.map(|s| s * 1.3);
        }
        self.width = side[0];
        self.inverse = side.map(|s| 1.0 / s);
        self.origin = low;
        self.corners = [low, high].map(Vec3::from);
        self.dims = std::array::from_fn(|a| cells(side, a) as usize);
    }

    /// Number of the cell along `axis` at `value`; outside the grid the first or last.
    fn along(&self, axis: usize, value: f32) -> usize {
        (((value - self.origin[axis]) * self.inverse[axis]) as usize).min(self.dims[axis] - 1)
    }

    fn cell_at(&self, p: &Particles, i: usize) -> u32 {
        let (x, y, z) = (self.along(0, p.x[i]), self.along(1, p.y[i]), self.along(2, p.z[i]));
        self.first_cell(x, z) as u32 + y as u32
    }

    /// The lowest cell of a column.
    fn first_cell(&self, x: usize, z: usize) -> usize {
        (z * self.dims[0] + x) * self.dims[1]
    }

    /// The particles of each column in order.
    pub fn columns(&self) -> impl Iterator<Item = Range<usize>> {
        let height = self.dims[1];
        (0..self.dims[0] * self.dims[2]).map(move |c| self.range(c * height, (c + 1) * height))
    }

    /// Calls `visit` with ranges that hold all particles within `reach` of the box from `low` to `high`.
    pub fn near(&self, low: [f32; 3], high: [f32; 3], reach: f32, mut visit: impl FnMut(Range<usize>)) {
        let span = |axis: usize| self.along(axis, low[axis] - reach)..=self.along(axis, high[axis] + reach);
        for z in span(2) {
            let beside = self.gap(2, z, low, high);
            for x in span(0) {
                let square = reach * reach - beside * beside - self.gap(0, x, low, high).powi(2);
                if square > 0.0 {
                    let (column, rest) = (self.first_cell(x, z), square.sqrt());
                    let (bottom, top) = (self.along(1, low[1] - rest), self.along(1, high[1] + rest));
                    visit(self.range(column + bottom, column + top + 1));
                }
            }
        }
    }

    /// How far the `k`-th column along `axis` lies from the box, m.
    fn gap(&self, axis: usize, k: usize, low: [f32; 3], high: [f32; 3]) -> f32 {
        let side = self.origin[axis] + k as f32 * self.width;
        (side - high[axis]).max(low[axis] - side - self.width).max(0.0)
    }

    fn range(&self, first: usize, end: usize) -> Range<usize> {
        self.start[first] as usize..self.start[end] as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particles::Newborn;

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
    fn columns_hold_every_particle_once_from_the_lowest_up() {
        for size in [0.05, 0.5, 3.0] {
            let (mut p, mut grid) = (cloud(300, size), Grid::default());
            grid.sort(&mut p, 0.04, 0.1, &[false; 300]);
            let mut next = 0;
            for column in grid.columns() {
                assert_eq!(column.start, next);
                next = column.end;
                assert!(column.clone().skip(1).all(|i| p.y[i - 1] <= p.y[i]));
                let width = |c: &[f32]| {
                    let c = &c[column.clone()];
                    c.iter().copied().fold(f32::MIN, f32::max) - c.iter().copied().fold(f32::MAX, f32::min)
                };
                let most = 1.001 * WIDTH * 0.04;
                assert!(column.is_empty() || (width(&p.x) < most && width(&p.z) < most));
            }
            assert_eq!(next, 300);
        }
    }

    #[test]
    fn ranges_hold_all_that_is_near() {
        for size in [0.05, 0.5, 3.0] {
            let (mut p, mut grid) = (cloud(300, size), Grid::default());
            grid.sort(&mut p, 0.04, 0.1, &[false; 300]);
            for k in 0..100 {
                let low = p.position(3 * k);
                let high = low + Vec3::new(0.01, 0.03, 0.02);
                let mut seen = Vec::new();
                grid.near(low.into(), high.into(), 0.1, |range| seen.extend(range));
                for i in 0..p.len() {
                    let at = p.position(i);
                    if at.distance(at.clamp(low, high)) < 0.0999 {
                        assert_eq!(seen.iter().filter(|&&j| j == i).count(), 1, "{i} at size {size}");
                    }
                }
                seen.sort_unstable();
                assert!(seen.windows(2).all(|w| w[0] < w[1]));
            }
        }
    }

    #[test]
    fn the_dead_are_dropped() {
        let (mut p, mut grid) = (cloud(10, 1.0), Grid::default());
        let dead: Vec<bool> = (0..10).map(|i| i % 2 == 0).collect();
        grid.sort(&mut p, 0.04, 0.1, &dead);
        assert_eq!(p.len(), 5);
        assert!(p.id[..5].iter().all(|id| id % 2 == 1));
        grid.sort(&mut p, 0.04, 0.1, &[true; 5]);
        assert_eq!(p.len(), 0);
    }

    #[test]
    fn a_wide_spread_stays_within_memory() {
        let mut p = Particles::new();
        let at = |x: f32| Newborn { position: Vec3::splat(x), ..Newborn::default() };
        p.extend(&[at(-500.0), at(500.0)]);
        let mut grid = Grid::default();
        grid.sort(&mut p, 0.004, 0.01, &[false, false]);
        assert!(grid.start.len() < 10_000_000);
    }
}
