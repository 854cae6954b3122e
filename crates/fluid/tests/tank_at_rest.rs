//! Water at rest in a tank carries a ball with the weight of the water that it displaces, stays level and stays
//! in; a one-way tool stirs it all the same and feels nothing.

#[cfg(test)]
mod common;

use common::{Run, ball_volume, tank_scene, vector};
use glam::DVec3;
use hapflow_fluid::{BodyDrive, BodySample, FluidConfig, ParticleView, Solver};

const SIDE: f64 = 0.2;
const RADIUS: f64 = 0.05;

/// Heights of the surface over the four quarters of the floor: the mean of the topmost layer's particles.
fn levels(view: &ParticleView, spacing: f64) -> [f64; 4] {
    let columns = (SIDE / spacing).round();
    let mut tops = vec![f64::NEG_INFINITY; (columns * columns) as usize];
    let column = |x: f64| ((x / SIDE + 0.5) * columns).clamp(0.0, columns - 1.0).floor();
    for p in view.positions.iter().map(vector) {
        let top = &mut tops[(column(p.x) * columns + column(p.z)) as usize];
        *top = top.max(p.y);
    }
    std::array::from_fn(|quarter| {
        let here = |k: &usize| {
            let (x, z) = ((*k as f64 / columns).floor(), *k as f64 % columns);
            usize::from(x >= columns / 2.0) * 2 + usize::from(z >= columns / 2.0) == quarter
        };
        let heights: Vec<_> =
            (0..tops.len()).filter(here).map(|k| tops[k]).filter(|y| y.is_finite()).collect();
        heights.iter().sum::<f64>() / heights.len() as f64
    })
}

#[test]
fn a_ball_is_carried_by_the_water_that_it_displaces() {
    for (solver, cells) in
        [(Solver::Wcsph, 14), (Solver::Wcsph, 18), (Solver::Dfsph, 14), (Solver::Dfsph, 18)]
    {
        let config = tank_scene(solver, SIDE, cells, RADIUS);
        let spacing = config.settings.spacing;
        let mut run = Run::new(&config);
        let count = run.snapshot().ids.len();
        run.run(0.5);
        let archimedes = 1000.0 * 9.81 * ball_volume(RADIUS);
        let force = run.mean_force(0.5) / archimedes;
        let view = run.snapshot();
        let levels = levels(&view, spacing);
        let lowest = view.positions.iter().map(|p| f64::from(p[1])).fold(f64::INFINITY, f64::min);
        assert!((force.y - 1.0).abs() < 0.03, "{solver:?}, {cells} cells: {force} of Archimedes' force");
        assert!(force.x.hypot(force.z) < 0.01, "{solver:?}, {cells} cells: {force} to the side");
        assert_eq!(view.ids.len(), count, "{solver:?}, {cells} cells: the tank leaks");
        assert!(lowest > 0.0, "{solver:?}, {cells} cells: a particle lies {lowest} m below the floor");
        let (low, high) = levels.iter().fold((f64::MAX, f64::MIN), |(l, h), &y| (l.min(y), h.max(y)));
        assert!(high - low < 0.25 * spacing, "{solver:?}, {cells} cells: not level: {levels:?}");
        // The topmost particles stand half a spacing below the surface.
        assert!(
            (low - (SIDE - 0.5 * spacing)).abs() < 0.5 * spacing,
            "{solver:?}, {cells} cells: {levels:?}"
        );
    }
}

/// Particles after a ball has been led through the tank, and its loads.
fn led(two_way: bool, cells: u32) -> (ParticleView, Vec<DVec3>) {
    let mut config: FluidConfig = tank_scene(Solver::Wcsph, 0.12, cells, 0.025);
    config.settings.two_way = two_way;
    let mut run = Run::new(&config);
    let at = |t: f64| BodySample {
        time: t,
        velocity: DVec3::new(0.6 * (20.0 * t).cos(), 0.0, 0.0),
        ..BodySample::at(DVec3::new(0.03 * (20.0 * t).sin(), 0.06, 0.0))
    };
    let mut loads = Vec::new();
    for k in 0..30 {
        let path = [at(0.01 * f64::from(k)), at(0.01 * f64::from(k + 1))];
        let load = run.frame_with(BodyDrive::Led, &path).loads[0];
        loads.extend([load.pressure_force, load.viscous_force, load.torque]);
    }
    (run.snapshot(), loads)
}

#[test]
fn a_one_way_tool_stirs_the_same_and_feels_nothing() {
    for cells in [8, 10] {
        let ((both, felt), (one, nothing)) = (led(true, cells), led(false, cells));
        assert!(both == one, "{cells} cells: the water moves otherwise");
        assert!(felt.iter().any(|f| f.length() > 0.1), "{cells} cells: two-way feels nothing");
        assert!(nothing.iter().all(|f| *f == DVec3::ZERO), "{cells} cells: one-way feels {nothing:?}");
    }
}
