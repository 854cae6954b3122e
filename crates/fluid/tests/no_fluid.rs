//! A world without fluid has no threads for it, and its bodies move all the same.
#![allow(clippy::unwrap_used)]

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, tank_scene};
use glam::DVec3;
use hapflow_fluid::{BodyDrive, BodySample, Shape};

/// The threads of this process, which runs this test alone.
#[cfg(target_os = "linux")]
fn threads() -> usize {
    std::fs::read_dir("/proc/self/task").unwrap().count()
}

#[test]
#[cfg(target_os = "linux")]
fn a_world_without_fluid_starts_no_thread() {
    let before = threads();
    for solver in SOLVERS {
        let mut config = tank_scene(solver, 0.1, 8, 0.02);
        config.world.pools.clear();
        config.world.bodies[0].shape = Shape::Box { size: DVec3::splat(0.02) };
        let mut run = Run::new(&config);
        let velocity = DVec3::Y;
        let at = |y: f64| BodySample { velocity, ..BodySample::at(DVec3::Y * y) };
        let path = [at(0.05), BodySample { time: 0.01, ..at(0.06) }];
        let output = run.frame_with(BodyDrive::Led, &path);
        assert_eq!(output.bodies[0].position.y, 0.06);
        assert_eq!((output.particles, output.loads[0].force()), (0, DVec3::ZERO));
        config.settings.viscosity = 1.0;
        run.configure(&config);
        run.run(0.05);
        assert_eq!(threads(), before, "{solver:?}");
    }
    // With a source, there are some.
    let mut config = tank_scene(SOLVERS[0], 0.1, 8, 0.02);
    config.world.pools.clear();
    let mut run = Run::new(&config);
    config.world.sources = vec![common::tap(0.15)];
    run.configure(&config);
    assert!(run.run(0.05).particles > 0);
    assert!(threads() > before);
}
