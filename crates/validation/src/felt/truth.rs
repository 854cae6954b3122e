//! What the hand should have felt: its own path, through a fluid that is stepped with it and answers at once.

use super::bench::in_parallel;
use crate::{Setup, ValidationError};
use glam::DVec3;
use hapflow_engine::{BackendKind, Scene, open_backend, run::TICK_S};
use hapflow_fluid::{BodyDrive, BodyMotion, BodySample, FluidBackend, FluidConfig, FluidError, FrameInput};

/// By how much longer than the last the fluid of each seed has run before, s: about a golden share of the time between
/// two layers of a jet, so that no two seeds agree.
const SEED_S: f64 = 1.7e-3;

/// The force on a path, tick by tick, from several fluids that differ by their seed alone.
#[derive(Clone, Debug)]
pub(crate) struct Truth {
    /// Mean over the seeds, N.
    pub mean: Vec<DVec3>,
    /// Each seed's own, N.
    pub seeds: Vec<Vec<DVec3>>,
}

impl Truth {
    /// Replays `path` (m, one place a tick) in the fluid of `scene`, with its factor on the force.
    pub fn replay(
        setup: &Setup<'_>,
        scene: &Scene,
        path: &[DVec3],
        seeds: usize,
    ) -> Result<Self, ValidationError> {
        let config = FluidConfig { frame_hz: 1.0 / TICK_S, ..scene.fluid_config(1) };
        let seeds = if scene.run.backend == BackendKind::AnalyticJet { 1 } else { seeds.max(1) };
        let one = |seed: usize| replay_seed(scene, &config, path, seed);
        let refused = |cause| ValidationError::Fluid { case: setup.case.name, dx: setup.dx, cause };
        let seeds = in_parallel(seeds, setup.threads(), one)
            .into_iter()
            .collect::<Result<Vec<_>, FluidError>>()
            .map_err(refused)?;
        Ok(Self { mean: mean_of(&seeds, None), seeds })
    }

    /// The mean of `figure` over the seeds, each against the mean of all others: what no coupling can fall below. 0 where
    /// there is only one.
    pub fn floor(&self, figure: impl Fn(&[DVec3], &[DVec3]) -> f64) -> f64 {
        let n = self.seeds.len();
        if n < 2 {
            return 0.0;
        }
        let of = |(k, seed): (usize, &Vec<DVec3>)| figure(seed, &mean_of(&self.seeds, Some(k)));
        self.seeds.iter().enumerate().map(of).sum::<f64>() / n as f64
    }
}

fn mean_of(seeds: &[Vec<DVec3>], without: Option<usize>) -> Vec<DVec3> {
    let kept: Vec<_> =
        seeds.iter().enumerate().filter(|(k, _)| Some(*k) != without).map(|(_, s)| s).collect();
    let ticks = kept.first().map_or(0, |s| s.len());
    (0..ticks).map(|n| kept.iter().map(|s| s[n]).sum::<DVec3>() / kept.len() as f64).collect()
}

fn replay_seed(
    scene: &Scene,
    config: &FluidConfig,
    path: &[DVec3],
    seed: usize,
) -> Result<Vec<DVec3>, FluidError> {
    let mut config = config.clone();
    config.world.seed = seed as u32;
    let mut fluid = open_backend(scene, &config)?;
    let start = path.first().copied().unwrap_or_default();
    if seed > 0 {
        step(&mut *fluid, SEED_S * seed as f64, [start, start]);
    }
    Ok(path.windows(2).map(|w| step(&mut *fluid, TICK_S, [w[0], w[1]]) * scene.tool.force_scale).collect())
}

/// One frame of `duration` seconds in which the tool goes straight; the mean force on it, N.
fn step(fluid: &mut dyn FluidBackend, duration: f64, [from, to]: [DVec3; 2]) -> DVec3 {
    let velocity = (to - from) / duration;
    let sample = |time, position| BodySample { time, velocity, ..BodySample::at(position) };
    let path = [sample(0.0, from), sample(duration, to)];
    fluid.submit(&FrameInput { duration, bodies: &[BodyMotion { drive: BodyDrive::Led, path: &path }] });
    fluid.poll().and_then(|out| out.loads.first()).map_or(DVec3::ZERO, |load| load.force())
}
