//! Fluid at rest sleeps and costs nothing, wakes when something comes near, and no force shows that it slept.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, aabb, ball_volume, tank_scene};
use glam::DVec3;
use hapflow_fluid::{BodyDrive, BodySample, Container, FluidConfig, Solver};

const SIDE: f64 = 0.1;
const RADIUS: f64 = 0.02;

/// A tank that may sleep, with the ball at `height`.
fn tank(solver: Solver, height: f64) -> FluidConfig {
    let mut config = tank_scene(solver, SIDE, 10, RADIUS);
    config.settings.sleep = true;
    config.world.bodies[0].position = DVec3::Y * height;
    config
}

/// Runs until all sleeps, `seconds` at most; whether it does.
fn falls_asleep(run: &mut Run, seconds: f64) -> bool {
    (0..(seconds * run.config.frame_hz) as usize).any(|_| run.frame().substeps == 1)
}

/// The frame in which the ball goes from one height to another.
fn lower(run: &mut Run, from: f64, to: f64) -> hapflow_fluid::FrameOutput {
    let duration = 1.0 / run.config.frame_hz;
    let velocity = DVec3::Y * (to - from) / duration;
    let at = |time: f64, y: f64| BodySample { time, velocity, ..BodySample::at(DVec3::Y * y) };
    run.frame_with(BodyDrive::Led, &[at(0.0, from), at(duration, to)])
}

#[test]
fn a_tank_at_rest_sleeps_as_it_is() {
    for solver in SOLVERS {
        let mut run = Run::new(&tank(solver, 0.17));
        let count = run.snapshot().ids.len();
        assert!(falls_asleep(&mut run, 6.0), "{solver:?}");
        let before = run.snapshot();
        let output = run.run(0.5);
        assert!(run.snapshot() == before, "{solver:?}: it moves in its sleep");
        assert_eq!((output.particles, output.substeps), (count, 1), "{solver:?}");
        assert_eq!(before.ids.len(), count, "{solver:?}");
    }
}

#[test]
fn it_does_not_sleep_unasked_or_stirred() {
    let mut config = tank(Solver::Wcsph, 0.05);
    config.settings.sleep = false;
    assert!(!falls_asleep(&mut Run::new(&config), 2.0));
    let mut run = Run::new(&tank(Solver::Wcsph, 0.05));
    for k in 0..300 {
        let height = |k: i32| 0.05 + 0.005 * (0.2 * f64::from(k)).sin();
        assert!(lower(&mut run, height(k), height(k + 1)).substeps > 1);
    }
}

#[test]
fn a_resting_ball_is_carried_by_what_sleeps_and_by_what_wakes() {
    let lift = 1000.0 * 9.81 * ball_volume(RADIUS);
    let mut run = Run::new(&tank(Solver::Wcsph, 0.05));
    assert!(falls_asleep(&mut run, 6.0));
    let asleep = run.mean_force(0.2).y;
    assert!((asleep / lift - 1.0).abs() < 0.05, "{asleep} N of {lift} N");
    // The slightest motion wakes it.
    let woken = |k: i32| {
        let height = |k: i32| 0.05 - 1e-5 * f64::from(k);
        lower(&mut run, height(k), height(k + 1))
    };
    let frames: Vec<_> = (0..20).map(woken).collect();
    assert!(frames[0].substeps > 1);
    let awake = frames.iter().map(|f| f.loads[0].force().y).sum::<f64>() / frames.len() as f64;
    assert!((awake / asleep - 1.0).abs() < 0.01, "asleep {asleep} N, awake {awake} N");
}

/// In the mean over starts: where its particles happen to be makes one dip differ from the next by 0.7 % of the lift, asleep
/// or awake.
#[test]
fn a_ball_that_dips_in_feels_no_sleep() {
    let dip = |sleep: bool, seed: u32| {
        let mut config = tank(Solver::Wcsph, 0.17);
        config.settings.sleep = sleep;
        config.world.seed = seed;
        let mut run = Run::new(&config);
        run.run(3.0);
        let height = |k: i32| 0.17 - 0.005 * f64::from(k);
        let forces = (0..28).map(|k| lower(&mut run, height(k), height(k + 1)).loads[0].force().y);
        forces.sum::<f64>() / 28.0
    };
    let mean = |sleep| (0..5).map(|seed| dip(sleep, seed)).sum::<f64>() / 5.0;
    let (slept, never) = (mean(true), mean(false));
    let lift = 1000.0 * 9.81 * ball_volume(RADIUS);
    assert!((slept - never).abs() < 0.01 * lift, "{slept} N after sleep, {never} N without");
}

/// A jet falls past a tank that sleeps.
#[test]
fn parts_sleep_apart_from_each_other() {
    let mut config = tank(Solver::Wcsph, 0.17);
    config.world.bounds = aabb([-0.1, -0.1, -0.1], [0.4, 0.3, 0.1]);
    config.world.container = Some(Container::open_box(aabb([-0.05, 0.0, -0.05], [0.05, 0.2, 0.05])));
    config.world.sources = vec![common::tap(0.2)];
    config.world.sources[0].position.x = 0.3;
    let steps = |run: &mut Run| {
        let view = run.snapshot();
        run.frame();
        let after = run.snapshot();
        let at = |view: &hapflow_fluid::ParticleView, id: u32| {
            view.ids.iter().position(|&i| i == id).map(|k| view.positions[k])
        };
        // Of the pool's first particle and of the last that was born.
        [0, view.ids.iter().copied().max().unwrap_or(0)].map(|id| at(&view, id) != at(&after, id))
    };
    let mut run = Run::new(&config);
    run.run(4.0);
    assert_eq!(steps(&mut run), [false, true], "the pool sleeps, and the jet falls");
    let mut new = config.clone();
    new.settings.viscosity = 0.01;
    run.configure(&new);
    assert_eq!(steps(&mut run), [true, true], "a setting wakes all");
}
