//! How fast a step is, stage by stage, against what this machine could do at most.

use super::machine::{Machine, machine};
use super::rig::cost;
use crate::ValidationError;
use crate::worlds;
use glam::{DVec3, IVec3, Vec3};
use hapflow_fluid::{
    Aabb, Container, CpuBackend, FluidBackend, FluidConfig, FluidSettings, FrameInput, ParticleView, Stage,
    World, step_limits,
};
use serde_json::{Map, json};
use std::collections::HashMap;
use std::time::Instant;

/// Particles that scenes are measured with, about.
const COUNTS: [f64; 5] = [1e3, 3e3, 1e4, 3e4, 1e5];
/// Time on the wall that a measurement takes at least, s, and sub-steps in it.
const LEAST: f64 = 1.0;
const LEAST_STEPS: usize = 20;
/// Operations for a pair within the support, with the kernel `low-pass`: 47 in the first pass, 45 in the second and a tenth of
/// 24 in the packing; counted in the source.
const FLOP_PER_PAIR: f64 = 94.0;
/// Bytes that a particle's own state and rows are read and written with in a step: 14 columns sorted, two records
/// written and read, two rows written and read, place and velocity moved.
const BYTES_PER_STEP: f64 = 14.0 * 8.0 + 2.0 * 64.0 + 2.0 * 100.0 + 48.0;

/// One scene at one size on so many threads.
#[derive(Clone, Debug)]
pub struct Speed {
    /// The scene.
    pub scene: &'static str,
    /// Particles.
    pub particles: usize,
    /// Worker threads.
    pub threads: usize,
    /// Sub-steps of a particle a second on the wall.
    pub rate: f64,
    /// The same a second of CPU time.
    pub rate_per_core: f64,
    /// Share of the time that each stage takes.
    pub stages: [(Stage, f64); 5],
    /// Pairs within the support, a particle.
    pub pairs: f64,
    /// Share of the machine's fused multiply-adds and of its memory's speed on as many threads, by CPU time.
    pub shares: [f64; 2],
    /// Exponent with which the cost of a step grows since the next smaller size.
    pub growth: Option<f64>,
}

impl Speed {
    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        let stages: Map<_, _> = self.stages.iter().map(|(s, t)| (stage_name(*s).into(), json!(t))).collect();
        json!({
            "scene": self.scene,
            "particles": self.particles,
            "threads": self.threads,
            "particle_steps_per_s": self.rate,
            "particle_steps_per_cpu_s": self.rate_per_core,
            "stages": stages,
            "pairs_per_particle": self.pairs,
            "fma_share": self.shares[0],
            "memory_share": self.shares[1],
            "growth": self.growth,
        })
    }
}

/// Name of a stage.
fn stage_name(stage: Stage) -> &'static str {
    match stage {
        Stage::Sort => "sort",
        Stage::Neighbours => "neighbours",
        Stage::Walls => "walls",
        Stage::Pairs => "pairs",
        Stage::Move => "move",
    }
}

/// Both scenes at all sizes on one and on two threads; `tell` hears of the machine's bounds first, and of each result.
///
/// # Errors
/// What the fluid refuses.
pub fn speed(mut bounds: impl FnMut(&Machine), mut tell: impl FnMut(&Speed)) -> Result<(), ValidationError> {
    let machines = [1, 2].map(machine);
    machines.iter().for_each(&mut bounds);
    for scene in ["tank", "dam-break"] {
        for machine in &machines {
            let mut smaller: Option<Speed> = None;
            for count in COUNTS {
                let mut speed = measure(scene, count, machine)?;
                speed.growth = smaller.map(|s| growth(&s, &speed));
                tell(&speed);
                smaller = Some(speed);
            }
        }
    }
    Ok(())
}

/// d log(cost of a step) / d log(particles).
fn growth(a: &Speed, b: &Speed) -> f64 {
    let (n, m) = (a.particles as f64, b.particles as f64);
    ((m / b.rate_per_core) / (n / a.rate_per_core)).ln() / (m / n).ln()
}

/// A cube of water, or a column of twice its length that falls into a basin three times as long.
fn config(scene: &str, count: f64, threads: usize) -> FluidConfig {
    let spacing = 0.4 / count.cbrt();
    let world = if scene == "tank" {
        worlds::tank(DVec3::splat(0.4))
    } else {
        // Square in front, half as wide.
        let edge = 0.4 * 2.0_f64.cbrt();
        let water = Aabb { min: DVec3::ZERO, max: DVec3::new(edge, edge, 0.5 * edge) };
        let inner = Aabb { min: DVec3::ZERO, max: DVec3::new(3.0 * edge, 2.0 * edge, 0.5 * edge) };
        let bounds = Aabb { min: inner.min - 0.1, max: inner.max + 0.1 };
        World { bounds, container: Some(Container::open_box(inner)), pools: vec![water], ..World::default() }
    };
    let settings = FluidSettings { spacing, max_particles: 1_000_000, ..FluidSettings::default() };
    FluidConfig { settings, world, frame_hz: 1000.0, threads }
}

fn measure(scene: &'static str, count: f64, machine: &Machine) -> Result<Speed, ValidationError> {
    let config = config(scene, count, machine.threads);
    let mut fluid = CpuBackend::new(&config)?;
    let step = step_limits(&config, config.reference_speed()).shortest();
    let input = FrameInput { duration: LEAST_STEPS as f64 * step, bodies: &[] };
    // The first steps make room for all that follow.
    fluid.submit_in(&input, LEAST_STEPS);
    fluid.time_stages();
    let (begun, mut steps, mut cpu) = (Instant::now(), 0, 0.0);
    while steps < LEAST_STEPS || begun.elapsed().as_secs_f64() < LEAST {
        cpu += cost(|| fluid.submit_in(&input, LEAST_STEPS));
        steps += LEAST_STEPS;
    }
    let (wall, times) = (begun.elapsed().as_secs_f64(), fluid.stage_times());
    let mut view = ParticleView::default();
    fluid.snapshot(&mut view);
    let work = (steps * view.ids.len()) as f64;
    let pairs = pairs(&view, config.settings.support_length());
    let (rate, rate_per_core) = (work / wall, work / cpu);
    // By CPU time, which another's work on the same cores does not change.
    let (all, stepped) =
        (rate_per_core * machine.threads as f64, Stage::ALL.map(|s| times.of(s)).iter().sum::<f64>());
    Ok(Speed {
        scene,
        particles: view.ids.len(),
        threads: machine.threads,
        rate,
        rate_per_core,
        stages: Stage::ALL.map(|stage| (stage, times.of(stage) / stepped)),
        pairs,
        shares: [
            all * pairs * FLOP_PER_PAIR / machine.flop_per_s,
            all * BYTES_PER_STEP / machine.bytes_per_s,
        ],
        growth: None,
    })
}

/// Mean number of particles within `support` (m) of one, itself left out.
fn pairs(view: &ParticleView, support: f64) -> f64 {
    let reach = support as f32;
    let cell = |p: Vec3| (p / reach).floor().as_ivec3();
    let mut cells: HashMap<IVec3, Vec<Vec3>> = HashMap::new();
    let places = || view.positions.iter().map(|p| Vec3::from(*p));
    places().for_each(|p| cells.entry(cell(p)).or_default().push(p));
    let near = |p: Vec3| {
        let around = (0..27).map(move |k| cell(p) + IVec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        around.filter_map(|c| cells.get(&c)).flatten().filter(|q| q.distance(p) < reach).count() - 1
    };
    places().map(near).sum::<usize>() as f64 / view.ids.len().max(1) as f64
}
