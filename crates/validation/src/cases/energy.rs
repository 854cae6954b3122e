//! Water that nothing drives never gains energy.

use super::dam_break;
use crate::case::{Case, Parameter};
use crate::reference::GRAVITY;
use crate::run::{Report, Run, vectors};
use crate::{Measure, Setup, ValidationError};
use hapflow_fluid::ParticleView;

/// Simulated time, in times of free fall from the column's top: it collapses, hits the far wall and comes back.
const FALLS: f64 = 6.0;

pub(super) const CASE: Case = Case {
    name: "energy",
    about: "a collapsing column in a closed tank: the greatest rise of kinetic, potential and elastic energy",
    source: "first law: without input energy never grows; scale: the column's energy above the floor",
    parameters: &[
        Parameter::number("side", "m", "0.2", [0.05, 2.0], "Side of the column, half as wide as high."),
        Parameter::DENSITY,
    ],
    length: "side",
    cells: [20.0, 26.0, 32.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let side = setup.number("side");
    let mut run = Run::start(setup, setup.config(dam_break::column(side)))?;
    let (density, sound) = (setup.number("density"), run.config().sound_speed());
    let mass = run.config().settings.particle_mass();
    let stiffness = 1.0 / (density * sound).powi(2);
    let (mut lowest, mut rise, mut first) = (f64::INFINITY, 0.0_f64, None);
    while run.time() < FALLS * (2.0 * side / GRAVITY).sqrt() {
        for _ in 0..run.steps_per_ms() {
            run.step(None);
        }
        let now = mass * energy(run.particles(), stiffness);
        lowest = lowest.min(now);
        rise = rise.max(now - lowest);
        first.get_or_insert(now);
    }
    let scale = first.unwrap_or(f64::NAN);
    Ok(run.report(vec![Measure::zero("drift", "J", rise, scale).goal(0.01)]))
}

/// Kinetic, potential and elastic energy of a unit of mass each (m²/s²), summed; the elastic one is p²/(2 ρ² c²).
fn energy(view: &ParticleView, stiffness: f64) -> f64 {
    let rows = vectors(&view.positions).zip(vectors(&view.velocities)).zip(&view.pressures);
    let one = |((x, v), p): ((glam::DVec3, glam::DVec3), &f32)| {
        0.5 * v.length_squared() + GRAVITY * x.y + 0.5 * stiffness * f64::from(*p).powi(2)
    };
    rows.map(one).sum()
}
