//! Fluids that are timed against each other.

use crate::worlds;
use glam::DVec3;
use hapflow_fluid::{
    BodyDrive, BodyMotion, BodySample, CpuBackend, FluidBackend, FluidConfig, FluidError, FluidSettings,
    FrameInput, FrameOutput, World,
};
use hapflow_realtime::process_cpu_s;

/// Fluid frames a second.
const FRAME_HZ: f64 = 100.0;

/// A fluid whose bodies are moved.
#[derive(Debug)]
pub(super) struct Rig {
    fluid: CpuBackend,
    config: FluidConfig,
    frames: usize,
}

/// A cube of water, `cells` particles along an edge of `side` (m), in a box twice as high.
pub(super) fn cube(side: f64, cells: f64) -> FluidConfig {
    let settings = FluidSettings { spacing: side / cells, ..FluidSettings::default() };
    FluidConfig { settings, world: worlds::tank(DVec3::splat(side)), frame_hz: FRAME_HZ, threads: 1 }
}

/// The same with something changed.
pub(super) fn with(config: &FluidConfig, change: impl FnOnce(&mut FluidSettings, &mut World)) -> FluidConfig {
    let mut config = config.clone();
    change(&mut config.settings, &mut config.world);
    config
}

impl Rig {
    pub fn new(config: FluidConfig) -> Result<Self, FluidError> {
        Ok(Self { fluid: CpuBackend::new(&config)?, config, frames: 0 })
    }

    /// One frame in which the first body is where `place` says at the frame's end (from its time, s), and the others where
    /// the world put them.
    pub fn frame(&mut self, place: impl Fn(f64) -> DVec3) -> FrameOutput {
        let length = 1.0 / FRAME_HZ;
        let times = [self.frames, self.frames + 1].map(|k| k as f64 * length);
        let paths: Vec<_> = (self.config.world.bodies.iter().enumerate())
            .map(|(k, body)| {
                let [from, to] = times.map(|time| if k == 0 { place(time) } else { body.position });
                let velocity = (to - from) / length;
                let at = |time: f64, place: DVec3| BodySample { time, velocity, ..BodySample::at(place) };
                [at(times[0], from), at(times[1], to)]
            })
            .collect();
        let motions: Vec<_> = paths.iter().map(|path| BodyMotion { drive: BodyDrive::Led, path }).collect();
        self.fluid.submit(&FrameInput { duration: length, bodies: &motions });
        self.frames += 1;
        self.fluid.poll().cloned().unwrap_or_default()
    }

    /// One frame in which all bodies rest.
    pub fn rest(&mut self) -> FrameOutput {
        let place = self.config.world.bodies.first().map_or(DVec3::ZERO, |b| b.position);
        self.frame(|_| place)
    }

    /// Rests for `seconds`.
    pub fn settle(&mut self, seconds: f64) {
        (0..(seconds * FRAME_HZ) as usize).for_each(|_| {
            self.rest();
        });
    }
}

/// CPU time of what `work` does, s.
pub(super) fn cost(work: impl FnOnce()) -> f64 {
    let before = process_cpu_s();
    work();
    process_cpu_s() - before
}

/// The middle one of some numbers.
pub(super) fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}
