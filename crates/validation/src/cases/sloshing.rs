//! Water in a box that is out of level swings at the frequency of its wave.

use crate::case::{Case, Parameter};
use crate::reference::wave_frequency;
use crate::run::{Report, Run, vectors};
use crate::{Measure, Setup, ValidationError, stats, worlds};
use glam::DVec3;
use hapflow_fluid::{Aabb, ParticleView, World};
use std::f64::consts::PI;

/// Height of the wave over its length/2π, where the linear theory is within a tenth of a per cent.
const STEEPNESS: f64 = 0.1;
/// Periods that are run.
const PERIODS: f64 = 3.0;
/// Width after which the box repeats, in spacings.
const WIDTH: f64 = 9.0;

pub(super) const CASE: Case = Case {
    name: "sloshing",
    about: "a standing wave in a box",
    source: "ω² = g k tanh k h with k = nπ/L, Lamb 1932, Hydrodynamics, 6th ed., §228",
    parameters: &[
        Parameter::number("length", "m", "0.4", [0.05, 4.0], "Length of the box."),
        Parameter::number("depth", "m", "0.2", [0.02, 2.0], "Depth of the water at rest."),
        Parameter::whole("mode", "1", [1.0, 3.0], "Half waves in the box."),
    ],
    length: "depth",
    cells: [16.0, 20.0, 24.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let (length, depth) = (setup.number("length"), setup.number("depth"));
    let k = setup.number("mode") * PI / length;
    let mut run = Run::start(setup, setup.config(world(setup.dx, length, depth, k)))?;
    let omega = wave_frequency(k, depth);
    let duration = PERIODS * 2.0 * PI / omega;
    let mut wave = Vec::new();
    while run.time() < duration {
        for _ in 0..run.steps_per_ms() {
            run.step(None);
        }
        let time = run.time();
        wave.push([time, amplitude(run.particles(), length, k)]);
    }
    let measured = stats::angular_frequency(&wave);
    Ok(run.report(vec![Measure::new("frequency", "rad/s", measured, omega).goal(0.015)]))
}

/// A box whose water stands in columns along a wave, a spacing wide each.
fn world(dx: f64, length: f64, depth: f64, k: f64) -> World {
    // It repeats in z; the container's walls there lie out of reach.
    let width = WIDTH * dx;
    let mut world = worlds::container(DVec3::new(length, 2.0 * depth, 3.0 * width));
    world.periodic[2] = true;
    (world.bounds.min.z, world.bounds.max.z) = (-0.5 * width, 0.5 * width);
    let count = (length / dx).round().max(1.0);
    let column = |i: f64| {
        let (left, right) = (length * (i / count - 0.5), length * ((i + 1.0) / count - 0.5));
        let height = depth + STEEPNESS / k * (k * (0.5 * (left + right) + 0.5 * length)).cos();
        Aabb { min: DVec3::new(left, 0.0, -0.5 * width), max: DVec3::new(right, height, 0.5 * width) }
    };
    world.pools = (0..count as usize).map(|i| column(i as f64)).collect();
    world
}

/// Amplitude of the wave, up to a factor: ∫η cos kx dx is the sum over all the water of cos kx.
fn amplitude(view: &ParticleView, length: f64, k: f64) -> f64 {
    let sum: f64 = vectors(&view.positions).map(|x| (k * (x.x + 0.5 * length)).cos()).sum();
    sum / view.positions.len() as f64
}
