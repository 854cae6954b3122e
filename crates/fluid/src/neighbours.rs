//! Who is near whom: for each particle the list of all that may touch it.
//!
//! Particles that lie together are looked round for together: a block of up to sixteen has one list of candidates, from which
//! each takes its own. The pair loops then take the neighbours of one particle in the lanes of a vector; nearly all of the pairs
//! that they see touch.
//!
//! Where the fluid is slow the lists reach a little farther than the support, and hold until somebody has gone half of that
//! way: the search and the sort before it are then left out.

use crate::grid::Grid;
use crate::lanes::{difference, dot, splat3};
use crate::particles::Particles;
use crate::vector_unit::{Arch, Unit, WIDEST, Work};
use rayon::prelude::*;
use std::ops::Range;

/// Most particles of a block.
const BLOCK: usize = 16;
/// Blocks a chunk: what one thread does at a time.
const CHUNK: usize = 8;
/// Longest block, in spacings: where fluid is thin fewer particles lie together.
const LONGEST: f32 = 3.0;
/// Rounding that the lists allow for.
const SLACK: f32 = 1.0001;

/// Lists of the particles of one chunk. Every vector here is longer than what is used of it.
#[derive(Clone, Debug, Default)]
struct Lists {
    /// Whole vectors: the last of a list is filled up with the number after that of the last particle.
    all: Vec<u32>,
    /// End of each particle's list in `all`.
    ends: Vec<u32>,
    ranges: Vec<Range<usize>>,
    candidates: Candidates,
}

/// Who may be near a block: numbers, and bits of the places along x, y, z.
#[derive(Clone, Debug, Default)]
struct Candidates {
    id: Vec<u32>,
    place: [Vec<u32>; 3],
    len: usize,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    /// First particle of each block, and the end of the last.
    first: Vec<u32>,
    lists: Vec<Lists>,
    /// Where the particles were when the lists were made, and which generation of them.
    places: [Vec<f32>; 3],
    generation: u64,
    /// How far each may go before the lists are made again, m.
    leeway: f32,
}

impl Neighbours {
    /// Finds all that comes within `support` of each of the sorted particles while none goes farther than `leeway`.
    pub fn find(
        &mut self,
        arch: Arch,
        grid: &Grid,
        p: &Particles,
        spacing: f32,
        [support, leeway]: [f32; 2],
    ) {
        self.remember(p, leeway);
        self.cut(grid, p, LONGEST * spacing);
        let chunks = self.chunks();
        // Lists that are not used at the moment keep their room.
        if self.lists.len() < chunks {
            self.lists.resize_with(chunks, Lists::default);
        }
        let (first, reach) = (&self.first, support * SLACK + 2.0 * leeway);
        self.lists[..chunks].par_iter_mut().enumerate().for_each(|(c, lists)| {
            let last = ((c + 1) * CHUNK).min(first.len() - 1);
            arch.run(Find { grid, p, reach, first: &first[c * CHUNK..=last], lists });
        });
    }

    fn remember(&mut self, p: &Particles, leeway: f32) {
        (self.leeway, self.generation) = (leeway, p.generation());
        if leeway > 0.0 {
            for (place, now) in self.places.iter_mut().zip([&p.x, &p.y, &p.z]) {
                place.clone_from(now);
            }
        }
    }

    /// Whether the lists still hold all that touch.
    pub fn hold(&self, p: &Particles) -> bool {
        let square = self.leeway * self.leeway;
        let [x, y, z] = &self.places;
        let gone = |i: usize| (p.x[i] - x[i]).powi(2) + (p.y[i] - y[i]).powi(2) + (p.z[i] - z[i]).powi(2);
        // Not a comparison the other way round: whose place is no number has gone.
        square > 0.0 && self.generation == p.generation() && (0..p.len()).all(|i| gone(i) <= square)
    }

    /// Forgets the lists.
    pub fn forget(&mut self) {
        self.leeway = 0.0;
    }

    /// How many chunks there are.
    pub fn chunks(&self) -> usize {
        self.first.len().saturating_sub(1).div_ceil(CHUNK)
    }

    /// The particles of a chunk; the end of all for the chunk after the last.
    #[inline]
    pub fn particles(&self, chunk: usize) -> Range<usize> {
        let first = |chunk: usize| self.first[(chunk * CHUNK).min(self.first.len() - 1)] as usize;
        first(chunk)..first(chunk + 1)
    }

    /// All that may touch each particle of a chunk, itself included, in whole vectors: filled up with a number that is no
    /// particle's.
    pub fn lists(&self, chunk: usize) -> impl Iterator<Item = &[u32]> {
        let lists = &self.lists[chunk];
        let mut start = 0;
        lists.ends.iter().map(move |&end| {
            let list = &lists.all[start..end as usize];
            start = end as usize;
            list
        })
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

impl Work for Find<'_> {
    #[inline(always)]
    fn run<U: Unit>(self, unit: U) {
        let Self { grid, p, reach, first, lists } = self;
        let Lists { all, ends, ranges, candidates } = lists;
        ends.clear();
        let mut end = 0;
        for bounds in first.windows(2) {
            let block = bounds[0] as usize..bounds[1] as usize;
            candidates.len = 0;
            // Images need no neighbours.
            if let Some((low, high)) = corners(p, block.clone()) {
                ranges.clear();
                grid.near(low, high, reach, |range| ranges.push(range));
                let corners = [splat3(unit, low), splat3(unit, high)];
                for range in ranges.iter() {
                    candidates.collect(unit, p, range.clone(), corners, reach * reach);
                }
            }
            let most = end + block.len() * (candidates.len + 2 * WIDEST);
            if all.len() < most {
                all.resize(2 * most, 0);
            }
            for i in block {
                if !p.is_image(i) {
                    end = candidates.pick(unit, p.position(i).into(), reach * reach, all, end);
                    end = fill_up(all, end, U::F32_LANES, p.len() as u32);
                }
                ends.push(end as u32);
            }
        }
    }
}

/// Fills the last vector of a list up with `nobody`. Returns the list's end.
#[inline(always)]
fn fill_up(all: &mut [u32], end: usize, lanes: usize, nobody: u32) -> usize {
    let whole = end.next_multiple_of(lanes);
    all[end..whole].fill(nobody);
    whole
}

/// The box round the particles of a block, images left out.
fn corners(p: &Particles, block: Range<usize>) -> Option<([f32; 3], [f32; 3])> {
    let real = block.filter(|&i| !p.is_image(i)).map(|i| p.position(i));
    let (low, high) = real.fold(None, |bounds, x| match bounds {
        None => Some((x, x)),
        Some((low, high)) => Some((x.min(low), x.max(high))),
    })?;
    Some((low.into(), high.into()))
}

/// Writes the lanes in `mask` to `out` from `end` on.
#[inline(always)]
fn pack<U: Unit>(unit: U, lanes: U::u32s, mask: usize, out: &mut [u32], end: usize) {
    if let Some(out) = out.get_mut(end..).and_then(<[u32]>::first_chunk_mut) {
        unit.pack(lanes, mask, out);
    }
}

impl Candidates {
    /// Takes those of `range` whose distance from the box is within the root of `square`.
    #[inline(always)]
    fn collect<U: Unit>(
        &mut self,
        unit: U,
        p: &Particles,
        range: Range<usize>,
        [low, high]: [[U::f32s; 3]; 2],
        square: f32,
    ) {
        let vectors = range.len().div_ceil(U::F32_LANES);
        let window = range.start..range.start + vectors * U::F32_LANES;
        self.make_room(self.len + window.len() + WIDEST);
        let columns = [&p.x[window.clone()], &p.y[window.clone()], &p.z[window]];
        let [x, y, z] = columns.map(|c| U::as_simd_f32s(c).0);
        let counting: [u32; WIDEST] = std::array::from_fn(|lane| lane as u32);
        let counting = U::as_simd_u32s(&counting).0[0];
        let mut first = range.start;
        for ((&x, &y), &z) in x.iter().zip(y).zip(z) {
            let mut sum = unit.splat_f32s(0.0);
            for (axis, value) in [x, y, z].into_iter().enumerate() {
                let gap = unit.max_f32s(unit.sub_f32s(low[axis], value), unit.sub_f32s(value, high[axis]));
                let gap = unit.max_f32s(gap, unit.splat_f32s(0.0));
                sum = unit.mul_add_e_f32s(gap, gap, sum);
            }
            // The last vector may reach into what comes after the range.
            let inside = (1 << (range.end - first).min(U::F32_LANES)) - 1;
            let mask = unit.at_most(sum, square) & inside;
            let ids = unit.add_u32s(unit.splat_u32s(first as u32), counting);
            pack(unit, ids, mask, &mut self.id, self.len);
            for (out, value) in self.place.iter_mut().zip([x, y, z]) {
                pack(unit, unit.transmute_u32s_f32s(value), mask, out, self.len);
            }
            self.len += mask.count_ones() as usize;
            first += U::F32_LANES;
        }
    }

    fn make_room(&mut self, len: usize) {
        if self.id.len() < len {
            let len = (2 * len).next_multiple_of(WIDEST);
            self.id.resize(len, 0);
            self.place.iter_mut().for_each(|place| place.resize(len, 0));
        }
    }

    /// Puts those within the root of `square` of a place into `list` from `end` on. Returns the new end.
    #[inline(always)]
    fn pick<U: Unit>(
        &self,
        unit: U,
        place: [f32; 3],
        square: f32,
        list: &mut [u32],
        mut end: usize,
    ) -> usize {
        let place = splat3(unit, place);
        let [x, y, z] = self.place.each_ref().map(|c| U::as_simd_u32s(c).0);
        let ids = U::as_simd_u32s(&self.id).0;
        let mut left = self.len;
        for (((&id, &x), &y), &z) in ids.iter().zip(x).zip(y).zip(z).take(self.len.div_ceil(U::F32_LANES)) {
            let at = [x, y, z].map(|c| unit.transmute_f32s_u32s(c));
            let d = difference(unit, place, at);
            let inside = (1 << left.min(U::F32_LANES)) - 1;
            let mask = unit.at_most(dot(unit, d, d), square) & inside;
            pack(unit, id, mask, list, end);
            end += mask.count_ones() as usize;
            left = left.saturating_sub(U::F32_LANES);
        }
        end
    }
}
