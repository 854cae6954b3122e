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
use rayon::prelude::*;

/// Kinematic viscosity that the solver of `config` adds to the stated one, m²/s.
pub(crate) fn artificial_viscosity(config: &FluidConfig) -> f64 {
    match config.settings.solver {
        Solver::Muller => muller::artificial_viscosity(config),
        Solver::Wcsph => wcsph::artificial_viscosity(config),
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

/// One row of results for each particle: what it means is the pass's own business.
pub(crate) type Rows = Vec<[f32; 4]>;

/// Runs `chunk(first, rows)` over all particles.
pub(crate) fn sweep(rows: &mut Rows, n: usize, chunk: impl Fn(usize, &mut [[f32; 4]]) + Sync) {
    rows.resize(n, [0.0; 4]);
    rows.par_chunks_mut(CHUNK).enumerate().for_each(|(c, rows)| chunk(c * CHUNK, rows));
}

/// Like [`sweep`], with loads on `loads.len()` bodies, added to `loads` in the order of the chunks.
pub(crate) fn sweep_with_loads(
    rows: &mut Rows,
    partial: &mut Vec<BodyLoad>,
    loads: &mut [BodyLoad],
    n: usize,
    chunk: impl Fn(usize, &mut [[f32; 4]], &mut [BodyLoad]) + Sync,
) {
    let bodies = loads.len();
    if bodies == 0 {
        return sweep(rows, n, |first, rows| chunk(first, rows, &mut []));
    }
    rows.resize(n, [0.0; 4]);
    partial.clear();
    partial.resize(n.div_ceil(CHUNK) * bodies, BodyLoad::default());
    let chunks = rows.par_chunks_mut(CHUNK).zip(partial.par_chunks_mut(bodies)).enumerate();
    chunks.for_each(|(c, (rows, loads))| chunk(c * CHUNK, rows, loads));
    for group in partial.chunks(bodies) {
        for (load, part) in loads.iter_mut().zip(group) {
            load.add_scaled(part, 1.0);
        }
    }
}

#[cfg(test)]
mod tests;
