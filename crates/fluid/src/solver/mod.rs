//! The solvers: what particles do to each other in one sub-step.
//!
//! Every pass goes over fixed chunks of blocks in parallel, the particles of a block in the lanes of a vector; a particle
//! gathers from its neighbours and writes only its own row, and loads on bodies are summed chunk by chunk in order, so
//! that results do not depend on the number of threads.

pub(crate) mod dfsph;
pub(crate) mod muller;
pub(crate) mod tension;
pub(crate) mod viscosity;
pub(crate) mod wcsph;

use crate::body::BodyLoad;
use crate::meetings::Meetings;
use crate::neighbours::{BLOCK, CHUNK, Neighbours};
use crate::particles::Particles;
use crate::{FluidConfig, Solver};
use pulp::Simd;
use rayon::prelude::*;
use std::ops::Range;

/// Kinematic viscosity that the solver of `config` adds to the stated one in a flow of this wave number (rad/m),
/// m²/s; that of `dfsph` grows with the speed, and is meant at the reference speed.
pub(crate) fn added_viscosity(config: &FluidConfig, wave_number: f64) -> f64 {
    match config.settings.solver {
        Solver::Muller => muller::artificial_viscosity(config),
        Solver::Wcsph | Solver::Dfsph => wcsph::noise_filter(config) * wave_number * wave_number,
    }
}

/// What a pass reads.
#[derive(Clone, Copy)]
pub(crate) struct Pass<'a> {
    pub arch: pulp::Arch,
    pub particles: &'a Particles,
    pub neighbours: &'a Neighbours,
    pub meetings: &'a Meetings,
}

/// Room for a pass to work in, kept from one to the next.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    records: Vec<Record>,
    loads: Vec<BodyLoad>,
}

/// Accelerations of the particles, or whatever else four numbers hold: what they mean is the pass's own business.
pub(crate) type Rows = Vec<[f32; 4]>;

/// What the pairs of a pass know of a particle; its place first.
pub(crate) type Record = [f32; 8];

/// Farther than any support from everything: the record of a lane without particle.
const NOBODY: f32 = 1e6;

/// What a pass computes of one particle: `OUT` sums over its neighbours of what the first `IN` numbers of their
/// records give, and of them its row and its share of the loads on the bodies.
pub(crate) trait RowPass<const IN: usize, const OUT: usize>: Copy + Sync {
    type Row: Copy + Default + Send;

    fn record(self, p: &Particles, i: usize) -> Record;

    /// Adds to `sums` what `j` gives to `i`, in every lane.
    fn pair<S: Simd>(self, simd: S, i: &[S::f32s; IN], j: &[S::f32s; IN], sums: &mut [S::f32s; OUT]);

    fn row(self, pass: &Pass<'_>, i: usize, sums: [f32; OUT], loads: &mut [BodyLoad]) -> Self::Row;
}

/// Runs `work` over all particles; its loads on `loads.len()` bodies are added to `loads` in the order of the chunks.
pub(crate) fn sweep<P: RowPass<IN, OUT>, const IN: usize, const OUT: usize>(
    pass: Pass<'_>,
    work: P,
    rows: &mut Vec<P::Row>,
    scratch: &mut Scratch,
    loads: &mut [BodyLoad],
) {
    let (n, blocks, bodies) = (pass.particles.len(), pass.neighbours.blocks(), loads.len());
    rows.resize(n, P::Row::default());
    scratch.records.resize(n, [0.0; 8]);
    let records = scratch.records.par_iter_mut().with_min_len(1024).enumerate();
    records.for_each(|(i, record)| *record = work.record(pass.particles, i));
    scratch.loads.clear();
    scratch.loads.resize(blocks.div_ceil(CHUNK) * bodies, BodyLoad::default());
    let sweep = Sweep { work, pass, records: &scratch.records, bodies };
    sweep.split(0..blocks, rows, &mut scratch.loads);
    for group in scratch.loads.chunks(bodies.max(1)) {
        for (load, part) in loads.iter_mut().zip(group) {
            load.add_scaled(part, 1.0);
        }
    }
}

#[derive(Clone, Copy)]
struct Sweep<'a, P> {
    work: P,
    pass: Pass<'a>,
    records: &'a [Record],
    bodies: usize,
}

impl<P: Copy + Sync> Sweep<'_, P> {
    /// Halves the blocks until they are a chunk, and leaves the halves to any thread.
    fn split<const IN: usize, const OUT: usize>(
        self,
        blocks: Range<usize>,
        rows: &mut [P::Row],
        loads: &mut [BodyLoad],
    ) where
        P: RowPass<IN, OUT>,
    {
        let chunks = blocks.len().div_ceil(CHUNK);
        if chunks <= 1 {
            return self.pass.arch.dispatch(Chunk { sweep: self, blocks, rows, loads });
        }
        let middle = blocks.start + chunks / 2 * CHUNK;
        let before =
            self.pass.neighbours.block(middle).start - self.pass.neighbours.block(blocks.start).start;
        let (rows, more_rows) = rows.split_at_mut(before);
        let (loads, more_loads) = loads.split_at_mut(chunks / 2 * self.bodies);
        rayon::join(
            || self.split(blocks.start..middle, rows, loads),
            || self.split(middle..blocks.end, more_rows, more_loads),
        );
    }
}

/// One chunk of a pass, compiled for the processor at hand.
struct Chunk<'a, P: RowPass<IN, OUT>, const IN: usize, const OUT: usize> {
    sweep: Sweep<'a, P>,
    blocks: Range<usize>,
    rows: &'a mut [P::Row],
    loads: &'a mut [BodyLoad],
}

impl<P: RowPass<IN, OUT>, const IN: usize, const OUT: usize> pulp::WithSimd for Chunk<'_, P, IN, OUT> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Sweep { work, pass, records, .. } = self.sweep;
        let mut rows = self.rows.iter_mut();
        let mut sums = [[0.0; BLOCK]; OUT];
        for block in self.blocks {
            let own = pass.neighbours.block(block);
            let all = pass.neighbours.of(block);
            pair_sums(simd, work, records, &records[own.clone()], all, &mut sums);
            for ((lane, i), row) in own.enumerate().zip(&mut rows) {
                if !pass.particles.is_image(i) {
                    let mut of_lane = [0.0; OUT];
                    for (sum, lanes) in of_lane.iter_mut().zip(&sums) {
                        *sum = lanes[lane];
                    }
                    *row = work.row(&pass, i, of_lane, self.loads);
                }
            }
        }
    }
}

/// The sums of a block's particles `own` over their neighbours, a particle a lane.
#[inline(always)]
fn pair_sums<S: Simd, P: RowPass<IN, OUT>, const IN: usize, const OUT: usize>(
    simd: S,
    work: P,
    records: &[Record],
    own: &[Record],
    neighbours: &[u32],
    sums: &mut [[f32; BLOCK]; OUT],
) {
    let mut columns = [[NOBODY; BLOCK]; IN];
    for (lane, record) in own.iter().enumerate() {
        for (column, value) in columns.iter_mut().zip(record) {
            column[lane] = *value;
        }
    }
    for part in 0..BLOCK / S::F32_LANES {
        let mut i = [simd.splat_f32s(0.0); IN];
        for (value, column) in i.iter_mut().zip(&columns) {
            *value = S::as_simd_f32s(column).0[part];
        }
        let mut sum = [simd.splat_f32s(0.0); OUT];
        for &neighbour in neighbours {
            let record = &records[neighbour as usize];
            let mut j = [simd.splat_f32s(0.0); IN];
            for (lanes, value) in j.iter_mut().zip(record) {
                *lanes = simd.splat_f32s(*value);
            }
            work.pair(simd, &i, &j, &mut sum);
        }
        for (out, lanes) in sums.iter_mut().zip(&sum) {
            S::as_mut_simd_f32s(out).0[part] = *lanes;
        }
    }
}

/// The widest lanes of this processor that are not wider than a block.
pub(crate) fn arch() -> pulp::Arch {
    #[cfg(target_arch = "x86_64")]
    return pulp::x86::V3::try_new().map_or(pulp::Arch::Scalar, pulp::Arch::V3);
    #[cfg(not(target_arch = "x86_64"))]
    return pulp::Arch::new();
}

#[cfg(test)]
mod tests;
