//! The solvers: what particles do to each other in one sub-step.
//!
//! Every pass goes over fixed chunks of particles in parallel, the neighbours of one in the lanes of a vector; a particle
//! gathers from its neighbours and writes only its own row, and loads on bodies are summed chunk by chunk in order, so
//! that results do not depend on the number of threads.

pub(crate) mod dfsph;
pub(crate) mod muller;
pub(crate) mod tension;
pub(crate) mod viscosity;
pub(crate) mod wcsph;

use crate::body::BodyLoad;
use crate::meetings::Meetings;
use crate::neighbours::Neighbours;
use crate::particles::Particles;
use crate::vector_unit::{Arch, Record, Stored, Unit, Work};
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
    pub arch: Arch,
    pub particles: &'a Particles,
    pub neighbours: &'a Neighbours,
    pub meetings: &'a Meetings,
}

/// Room for a pass to work in, kept from one to the next.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    records: Vec<Stored>,
    loads: Vec<BodyLoad>,
}

/// Accelerations of the particles, or whatever else four numbers hold: what they mean is the pass's own business.
pub(crate) type Rows = Vec<[f32; 4]>;

/// What fills lists up: farther than any support from everything.
const NOBODY: Stored = Stored([1e6, 1e6, 1e6, 0.0, 0.0, 0.0, 0.0, 0.0]);

/// What a pass computes of one particle: `OUT` sums over its neighbours of what the first `IN` numbers of their
/// records give, and of them its row and its share of the loads on the bodies.
pub(crate) trait RowPass<const IN: usize, const OUT: usize>: Copy + Sync {
    type Row: Copy + Default + Send;

    /// What its pairs know of a particle; its place first.
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
    let (n, chunks, bodies) = (pass.particles.len(), pass.neighbours.chunks(), loads.len());
    rows.resize(n, P::Row::default());
    scratch.records.resize(n + 1, NOBODY);
    scratch.records[n] = NOBODY;
    let records = scratch.records[..n].par_iter_mut().with_min_len(1024).enumerate();
    records.for_each(|(i, record)| record.0 = work.record(pass.particles, i));
    scratch.loads.clear();
    scratch.loads.resize(chunks * bodies, BodyLoad::default());
    let sweep = Sweep { work, pass, records: &scratch.records, bodies };
    sweep.split(0..chunks, rows, &mut scratch.loads);
    BodyLoad::add_chunks(loads, &scratch.loads);
}

#[derive(Clone, Copy)]
struct Sweep<'a, P> {
    work: P,
    pass: Pass<'a>,
    records: &'a [Stored],
    bodies: usize,
}

impl<P: Copy + Sync> Sweep<'_, P> {
    /// Halves the chunks until one is left, and leaves the halves to any thread.
    fn split<const IN: usize, const OUT: usize>(
        self,
        chunks: Range<usize>,
        rows: &mut [P::Row],
        loads: &mut [BodyLoad],
    ) where
        P: RowPass<IN, OUT>,
    {
        if chunks.is_empty() {
            return;
        }
        if chunks.len() == 1 {
            return self.pass.arch.run(Chunk { sweep: self, chunk: chunks.start, rows, loads });
        }
        let half = chunks.len() / 2;
        let middle = chunks.start + half;
        let first = |chunk: usize| self.pass.neighbours.particles(chunk).start;
        let (rows, more_rows) = rows.split_at_mut(first(middle) - first(chunks.start));
        let (loads, more_loads) = loads.split_at_mut(half * self.bodies);
        rayon::join(
            || self.split(chunks.start..middle, rows, loads),
            || self.split(middle..chunks.end, more_rows, more_loads),
        );
    }
}

/// One chunk of a pass, compiled for the processor at hand.
struct Chunk<'a, P: RowPass<IN, OUT>, const IN: usize, const OUT: usize> {
    sweep: Sweep<'a, P>,
    chunk: usize,
    rows: &'a mut [P::Row],
    loads: &'a mut [BodyLoad],
}

impl<P: RowPass<IN, OUT>, const IN: usize, const OUT: usize> Work for Chunk<'_, P, IN, OUT> {
    #[inline(always)]
    fn run<U: Unit>(self, unit: U) {
        let Sweep { work, pass, records, .. } = self.sweep;
        let own = pass.neighbours.particles(self.chunk);
        for ((i, list), row) in own.zip(pass.neighbours.lists(self.chunk)).zip(self.rows) {
            if !pass.particles.is_image(i) {
                let sums = pair_sums(unit, work, records, i, list);
                *row = work.row(&pass, i, sums, self.loads);
            }
        }
    }
}

/// The sums of particle `i` over its neighbours, a neighbour a lane.
#[inline(always)]
fn pair_sums<U: Unit, P: RowPass<IN, OUT>, const IN: usize, const OUT: usize>(
    unit: U,
    work: P,
    records: &[Stored],
    i: usize,
    neighbours: &[u32],
) -> [f32; OUT] {
    let mut own = [unit.splat_f32s(0.0); IN];
    for (lanes, value) in own.iter_mut().zip(&records[i].0) {
        *lanes = unit.splat_f32s(*value);
    }
    let mut sums = [unit.splat_f32s(0.0); OUT];
    for of in neighbours.chunks_exact(U::F32_LANES) {
        let others = unit.columns(records, of);
        work.pair(unit, &own, &others, &mut sums);
    }
    let mut out = [0.0; OUT];
    for (out, lanes) in out.iter_mut().zip(sums) {
        *out = unit.reduce_sum_f32s(lanes);
    }
    out
}

#[cfg(test)]
mod tests;
