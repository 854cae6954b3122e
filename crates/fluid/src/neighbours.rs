//! Who is near whom: blocks of up to eight particles that lie together, and for each the list of all particles
//! that may touch one of them.
//!
//! The pair loops take the particles of a block in the lanes of a vector and its neighbours one by one, so that
//! nothing is gathered and no lanes are summed up. Of the pairs that they see a third touch.

use crate::grid::Grid;
use crate::lanes::splat3;
use crate::particles::Particles;
use pulp::Simd;
use rayon::prelude::*;
use std::ops::Range;

/// Most particles of a block.
pub(crate) const BLOCK: usize = 8;
/// Blocks a chunk: what one thread does at a time.
pub(crate) const CHUNK: usize = 8;
/// Longest block, in spacings: where fluid is thin fewer particles lie together.
const LONGEST: f32 = 3.0;
/// Rounding that the lists allow for.
const SLACK: f32 = 1.0001;

/// Neighbours of the blocks of one chunk.
#[derive(Clone, Debug, Default)]
struct Lists {
    /// Longer than what is used of it.
    all: Vec<u32>,
    /// End of each block's list in `all`.
    ends: [usize; CHUNK],
    ranges: Vec<Range<usize>>,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    /// First particle of each block, and the end of the last.
    first: Vec<u32>,
    lists: Vec<Lists>,
}

impl Neighbours {
    /// Finds the blocks of sorted particles, and all that lies within `support` of them.
    pub fn find(&mut self, arch: pulp::Arch, grid: &Grid, p: &Particles, spacing: f32, support: f32) {
        self.cut(grid, p, LONGEST * spacing);
        let chunks = self.blocks().div_ceil(CHUNK);
        // Lists that are not used at the moment keep their room.
        if self.lists.len() < chunks {
            self.lists.resize_with(chunks, Lists::default);
        }
        let first = &self.first;
        self.lists[..chunks].par_iter_mut().enumerate().for_each(|(c, lists)| {
            let last = ((c + 1) * CHUNK).min(first.len() - 1);
            arch.dispatch(Find { grid, p, reach: support * SLACK, first: &first[c * CHUNK..=last], lists });
        });
    }

    /// How many blocks there are.
    pub fn blocks(&self) -> usize {
        self.first.len().saturating_sub(1)
    }

    /// The particles of a block.
    #[inline]
    pub fn block(&self, block: usize) -> Range<usize> {
        self.first[block] as usize..self.first[block + 1] as usize
    }

    /// All that may touch a particle of the block, its own included.
    #[inline]
    pub fn of(&self, block: usize) -> &[u32] {
        let (lists, k) = (&self.lists[block / CHUNK], block % CHUNK);
        let start = if k == 0 { 0 } else { lists.ends[k - 1] };
        &lists.all[start..lists.ends[k]]
    }

    /// Cuts the columns into blocks.
    fn cut(&mut self, grid: &Grid, p: &Particles, longest: f32) {
        self.first.clear();
        self.first.push(0);
        for column in grid.columns() {
            let mut first = column.start;
            for i in column.clone() {
                if i - first == BLOCK || p.y[i] - p.y[first] > longest {
                    self.first.push(i as u32);
                    first = i;
                }
            }
            if !column.is_empty() {
                self.first.push(column.end as u32);
            }
        }
    }
}

/// Fills the lists of one chunk.
struct Find<'a> {
    grid: &'a Grid,
    p: &'a Particles,
    reach: f32,
    first: &'a [u32],
    lists: &'a mut Lists,
}

impl pulp::WithSimd for Find<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { grid, p, reach, first, lists } = self;
        let mut end = 0;
        for (k, ends) in first.windows(2).enumerate() {
            let block = ends[0] as usize..ends[1] as usize;
            // Images need no neighbours.
            if let Some((low, high)) = bounds(p, block) {
                lists.ranges.clear();
                grid.near(low, high, reach, |range| lists.ranges.push(range));
                let corners = [splat3(simd, low), splat3(simd, high)];
                for range in &lists.ranges {
                    end += collect(simd, p, range.clone(), corners, reach * reach, &mut lists.all, end);
                }
            }
            lists.ends[k] = end;
        }
    }
}

/// The box round the particles of a block, images left out.
fn bounds(p: &Particles, block: Range<usize>) -> Option<([f32; 3], [f32; 3])> {
    let real = block.filter(|&i| !p.is_image(i)).map(|i| p.position(i));
    let (low, high) = real.fold(None, |bounds, x| match bounds {
        None => Some((x, x)),
        Some((low, high)) => Some((x.min(low), x.max(high))),
    })?;
    Some((low.into(), high.into()))
}

/// Puts those of `range` into `list` from `end` on whose distance from the box is within the root of `square`. Returns how
/// many.
#[inline(always)]
fn collect<S: Simd>(
    simd: S,
    p: &Particles,
    range: Range<usize>,
    [low, high]: [[S::f32s; 3]; 2],
    square: f32,
    list: &mut Vec<u32>,
    end: usize,
) -> usize {
    let lanes = S::F32_LANES;
    let vectors = range.len().div_ceil(lanes);
    let window = range.start..range.start + vectors * lanes;
    if list.len() < end + window.len() {
        list.resize(2 * (end + window.len()), 0);
    }
    let found = &mut list[end..];
    let columns = [&p.x[window.clone()], &p.y[window.clone()], &p.z[window]];
    let [x, y, z] = columns.map(|c| S::as_simd_f32s(c).0);
    let mut distances = [0.0_f32; 16];
    let (mut count, mut first) = (0, range.start);
    for ((&x, &y), &z) in x.iter().zip(y).zip(z) {
        let mut sum = simd.splat_f32s(0.0);
        for (axis, value) in [x, y, z].into_iter().enumerate() {
            let gap = simd.max_f32s(simd.sub_f32s(low[axis], value), simd.sub_f32s(value, high[axis]));
            let gap = simd.max_f32s(gap, simd.splat_f32s(0.0));
            sum = simd.mul_add_e_f32s(gap, gap, sum);
        }
        S::as_mut_simd_f32s(&mut distances[..lanes]).0[0] = sum;
        for (lane, &distance) in distances[..lanes.min(range.end - first)].iter().enumerate() {
            // Every one is written, and kept by counting on: no branch to foresee.
            found[count] = (first + lane) as u32;
            count += usize::from(distance <= square);
        }
        first += lanes;
    }
    count
}
