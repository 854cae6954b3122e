//! The two solvers: what particles do to each other in one sub-step.
//!
//! Every pass goes over fixed chunks of particles in parallel; a particle gathers from its neighbours and
//! writes only its own row, and loads on bodies are summed chunk by chunk in order, so that results do not
//! depend on the number of threads.

pub(crate) mod muller;
pub(crate) mod wcsph;

use crate::body::BodyLoad;
use crate::grid::Grid;
use crate::particles::Particles;
use crate::solids::Solids;
use crate::{FluidConfig, Solver};
use pulp::Simd;
use rayon::prelude::*;

/// Kinematic viscosity that the solver of `config` adds to the stated one in a flow of this wave number (rad/m),
/// m²/s.
pub(crate) fn added_viscosity(config: &FluidConfig, wave_number: f64) -> f64 {
    match config.settings.solver {
        Solver::Muller => muller::artificial_viscosity(config),
        Solver::Wcsph => wcsph::noise_filter(config) * wave_number * wave_number,
    }
}

/// Particles a chunk.
pub(crate) const CHUNK: usize = 64;

/// What a pass reads.
#[derive(Clone, Copy)]
pub(crate) struct Pass<'a> {
    pub arch: pulp::Arch,
    pub particles: &'a Particles,
    pub grid: &'a Grid,
    pub solids: Solids<'a>,
}

/// Accelerations of the particles, or whatever else four numbers hold: what they mean is the pass's own business.
pub(crate) type Rows = Vec<[f32; 4]>;

/// What a pass computes of one particle and its neighbours: its row, and its share of the loads on the bodies.
pub(crate) trait RowPass: Copy + Sync {
    type Row: Copy + Default + Send;

    fn row<S: Simd>(self, simd: S, pass: &Pass<'_>, i: usize, loads: &mut [BodyLoad]) -> Self::Row;
}

/// One chunk of a pass, compiled for the processor at hand.
struct Chunk<'a, P: RowPass> {
    work: P,
    pass: Pass<'a>,
    first: usize,
    rows: &'a mut [P::Row],
    loads: &'a mut [BodyLoad],
}

impl<P: RowPass> pulp::WithSimd for Chunk<'_, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (k, row) in self.rows.iter_mut().enumerate() {
            if self.pass.particles.is_image(self.first + k) {
                continue;
            }
            *row = self.work.row(simd, &self.pass, self.first + k, self.loads);
        }
    }
}

/// Runs `work` over all particles.
pub(crate) fn sweep<P: RowPass>(pass: Pass<'_>, work: P, rows: &mut Vec<P::Row>) {
    rows.resize(pass.particles.len(), P::Row::default());
    rows.par_chunks_mut(CHUNK).enumerate().for_each(|(c, rows)| {
        pass.arch.dispatch(Chunk { work, pass, first: c * CHUNK, rows, loads: &mut [] });
    });
}

/// Like [`sweep`], with loads on `loads.len()` bodies, added to `loads` in the order of the chunks.
pub(crate) fn sweep_with_loads<P: RowPass>(
    pass: Pass<'_>,
    work: P,
    rows: &mut Vec<P::Row>,
    partial: &mut Vec<BodyLoad>,
    loads: &mut [BodyLoad],
) {
    let (bodies, n) = (loads.len(), pass.particles.len());
    if bodies == 0 {
        return sweep(pass, work, rows);
    }
    rows.resize(n, P::Row::default());
    partial.clear();
    partial.resize(n.div_ceil(CHUNK) * bodies, BodyLoad::default());
    let chunks = rows.par_chunks_mut(CHUNK).zip(partial.par_chunks_mut(bodies)).enumerate();
    chunks.for_each(|(c, (rows, loads))| {
        pass.arch.dispatch(Chunk { work, pass, first: c * CHUNK, rows, loads });
    });
    for group in partial.chunks(bodies) {
        for (load, part) in loads.iter_mut().zip(group) {
            load.add_scaled(part, 1.0);
        }
    }
}

#[cfg(test)]
mod tests;
