//! A square column of water collapses: its front runs as it did in 1952.

use crate::case::{Case, Parameter};
use crate::reference::{COLUMN_FRONT, GRAVITY};
use crate::run::{Report, Run, vectors};
use crate::{Measure, Setup, ValidationError, worlds};
use glam::DVec3;
use hapflow_fluid::{Aabb, ParticleView};

pub(super) const CASE: Case = Case {
    name: "dam-break",
    about: "front of a collapsing square column, half as wide as high: how far it is ahead of the experiment",
    source: "Martin & Moyce 1952 (doi:10.1098/rsta.1952.0006), square column; the goal is the best of the peers run beside it",
    parameters: &[Parameter::number("side", "m", "0.5", [0.05, 2.0], "Side of the column.")],
    length: "side",
    cells: [28.0, 36.0, 46.0],
    variants: &[],
    run,
};

fn run(setup: &Setup<'_>) -> Result<Report, ValidationError> {
    let side = setup.number("side");
    let mut run = Run::start(setup, setup.config(column(side)))?;
    let unit = (side / GRAVITY).sqrt();
    let mut path = vec![[0.0, 1.0]];
    let mut end = path[0];
    while end[1] < 3.05 && end[0] < 4.0 {
        for _ in 0..run.steps_per_ms() {
            run.step(None);
        }
        let time = run.time() / unit;
        end = [time, (front(run.particles(), setup.dx) + 0.5 * side) / side];
        path.push(end);
    }
    Ok(run.report(vec![Measure::zero("front_lead", "1", lead(&path), 1.0).goal(0.10)]))
}

/// A tank three times as long as the column, which stands in its end; x = −side/2 is the back wall.
pub(super) fn column(side: f64) -> hapflow_fluid::World {
    let half = 0.5 * side;
    let mut world = worlds::container(DVec3::new(3.5 * side, 2.0 * side, half));
    let water = DVec3::new(side, side, half);
    let shift = |b: &mut Aabb| {
        b.min.x += 1.25 * side;
        b.max.x += 1.25 * side;
    };
    world.container.iter_mut().for_each(|c| shift(&mut c.inner));
    shift(&mut world.bounds);
    world.pools = vec![worlds::upright(water)];
    world
}

/// Foremost point of the water but for one particle in two thousand, m.
fn front(view: &ParticleView, dx: f64) -> f64 {
    let mut xs: Vec<f64> = vectors(&view.positions).map(|x| x.x).collect();
    xs.sort_by(f64::total_cmp);
    xs[xs.len() - (xs.len() / 2000).max(1)] + 0.5 * dx
}

/// Mean time by which `path` (time, place) is ahead of the experiment.
fn lead(path: &[[f64; 2]]) -> f64 {
    let ahead = |[time, place]: &[f64; 2]| time - arrival(path, *place);
    COLUMN_FRONT.iter().map(ahead).sum::<f64>() / COLUMN_FRONT.len() as f64
}

/// Time at which `path` first reaches `place`; NaN if it never does.
fn arrival(path: &[[f64; 2]], place: f64) -> f64 {
    let reaches = path.windows(2).find(|w| w[1][1] >= place);
    reaches.map_or(f64::NAN, |w| w[0][0] + (w[1][0] - w[0][0]) * (place - w[0][1]) / (w[1][1] - w[0][1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_experiment_itself_leads_by_nothing() {
        let mut path = vec![[0.0, 1.0]];
        path.extend(COLUMN_FRONT);
        assert!(lead(&path).abs() < 1e-12);
        let early: Vec<_> = path.iter().map(|p| [p[0] - 0.1, p[1]]).collect();
        assert!((lead(&early) - 0.1).abs() < 1e-9);
        assert!(lead(&path[..3]).is_nan());
    }
}
