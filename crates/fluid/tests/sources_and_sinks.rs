//! Water comes and goes as it was said: sources give their flow, and age, sinks, bounds and the limit on particles
//! take away or hold back exactly what they should.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, aabb, assert_finite, jet_scene, tank_scene, vector};
use glam::DVec3;
use hapflow_fluid::{CpuBackend, FluidBackend, FluidConfig, FluidError, InteractionMode, Solver};

/// A jet that meets nothing.
fn free_jet(solver: Solver, spacing: f64) -> FluidConfig {
    let mut config = jet_scene(solver, spacing);
    config.world.bodies.clear();
    config.world.bounds = aabb([-0.2, -0.5, -0.2], [0.2, 0.3, 0.2]);
    config.frame_hz = 250.0;
    config
}

fn volume(run: &mut Run) -> f64 {
    run.snapshot().ids.len() as f64 * run.config.settings.spacing.powi(3)
}

/// Volume of the particles of one layer of the first source, m³.
fn layer(config: &FluidConfig) -> f64 {
    let (s, dx) = (&config.world.sources[0], config.settings.spacing);
    (s.flow() / s.speed / dx.powi(2)).round() * dx.powi(3)
}

#[test]
fn a_jet_carries_its_flow_at_its_speed() {
    for solver in SOLVERS {
        for spacing in [0.005, 0.0035] {
            let config = free_jet(solver, spacing);
            let mut run = Run::new(&config);
            run.run(0.2);
            let given = config.world.sources[0].flow() * 0.2;
            assert!((volume(&mut run) - given).abs() < 1.01 * layer(&config), "{solver:?}, dx {spacing} m");
            // Free fall: v² = v₀² + 2 g s.
            let view = run.snapshot();
            for (x, v) in view.positions.iter().map(vector).zip(view.velocities.iter().map(vector)) {
                // Gravity takes over from the source after two spacings.
                let fallen = (0.06 - 2.0 * spacing - x.y).max(0.0);
                let free = (1.5 * 1.5 + 2.0 * 9.81 * fallen).sqrt();
                assert!((-v.y - free).abs() < 0.1, "{solver:?}, dx {spacing} m: {v} after {fallen} m");
            }
        }
    }
}

#[test]
fn an_intermittent_jet_runs_its_duty() {
    for (period, duty) in [(0.05, 0.3), (0.1, 0.5), (0.02, 1.0)] {
        let mut config = free_jet(Solver::Wcsph, 0.004);
        config.settings.mode = InteractionMode::None;
        (config.world.sources[0].period, config.world.sources[0].duty) = (period, duty);
        let mut run = Run::new(&config);
        run.run(0.2);
        let given = config.world.sources[0].flow() * 0.2 * duty;
        let got = volume(&mut run);
        assert!(
            (got - given).abs() < 0.02 * given + 1.01 * layer(&config),
            "{period} s, {duty}: {got} of {given} m³"
        );
        // A gap is a gap: nothing stands in the band that left the tap while it was closed.
        if duty < 1.0 {
            let age = |y: f64| ((1.5_f64.powi(2) + 2.0 * 9.81 * (0.06 - y).max(0.0)).sqrt() - 1.5) / 9.81;
            let phase = |y: f64| (0.2 - age(y)).rem_euclid(period) / period;
            let view = run.snapshot();
            let stray = view.positions.iter().filter(|p| {
                let phase = phase(f64::from(p[1]));
                phase > duty + 0.15 && phase < 0.9
            });
            assert_eq!(stray.count(), 0, "{period} s, {duty}");
        }
    }
}

#[test]
fn a_closed_source_gives_nothing_and_can_be_opened() {
    let mut config = free_jet(Solver::Wcsph, 0.005);
    config.world.sources[0].on = false;
    let mut run = Run::new(&config);
    assert_eq!(run.run(0.05).particles, 0);
    config.world.sources[0].on = true;
    run.configure(&config);
    run.run(0.05);
    let given = config.world.sources[0].flow() * 0.05;
    assert!((volume(&mut run) - given).abs() < 1.01 * layer(&config), "{given}");
}

#[test]
fn particles_vanish_at_their_age() {
    for solver in SOLVERS {
        for lifetime in [0.05, 0.1] {
            let mut config = free_jet(solver, 0.005);
            config.settings.lifetime = lifetime;
            let mut run = Run::new(&config);
            run.run(0.04);
            let early = run.snapshot().ids;
            run.run(0.16);
            let given = config.world.sources[0].flow() * lifetime;
            let got = volume(&mut run);
            assert!(
                (got - given).abs() < 1.2 * layer(&config),
                "{solver:?}, {lifetime} s: {got} of {given} m³"
            );
            let late = run.snapshot().ids;
            assert!(
                late.iter().all(|id| !early.contains(id)),
                "{solver:?}: an old one lives, or an id came twice"
            );
        }
    }
}

#[test]
fn sinks_swallow_and_bounds_end_the_world() {
    for solver in SOLVERS {
        for spacing in [0.005, 0.004] {
            let mut config = free_jet(solver, spacing);
            config.world.bounds.min.y = -0.1;
            let mut run = Run::new(&config);
            let above = |y: f64, run: &mut Run| {
                let view = run.snapshot();
                assert_finite(&view, "sink");
                // What has crossed in the last sub-step goes in the next.
                assert!(view.positions.iter().all(|p| f64::from(p[1]) > y - 0.004), "{solver:?}");
                view.positions.iter().filter(|p| f64::from(p[1]) < y + 0.03).count()
            };
            run.run(0.3);
            assert!(above(-0.1, &mut run) > 0, "{solver:?}: the jet must reach the bound");
            config.world.sinks = vec![aabb([-0.1, -0.08, -0.1], [0.1, -0.03, 0.1])];
            run.configure(&config);
            run.run(0.05);
            assert!(above(-0.03, &mut run) > 0, "{solver:?}: the jet must reach the sink");
            // Steady again: what is there is what has been given since it takes to fall to the sink.
            let fall = ((1.5_f64.powi(2) + 2.0 * 9.81 * 0.09).sqrt() - 1.5) / 9.81;
            let (got, given) = (volume(&mut run), config.world.sources[0].flow() * fall);
            assert!((got / given - 1.0).abs() < 0.1, "{solver:?}: {got} of {given} m³");
        }
    }
}

#[test]
fn the_limit_on_particles_holds() {
    for solver in SOLVERS {
        let mut config = free_jet(solver, 0.005);
        config.settings.max_particles = 200;
        let mut run = Run::new(&config);
        let mut most = 0;
        for _ in 0..100 {
            most = most.max(run.frame().particles);
        }
        assert!(most <= 200 && most > 150, "{solver:?}: {most}");
    }
    let mut config = tank_scene(Solver::Wcsph, 0.1, 10, 0.02);
    config.settings.max_particles = 900;
    let error = CpuBackend::new(&config).unwrap_err();
    assert_eq!(error, FluidError::TooManyParticles { needed: 1000, allowed: 900 });
    assert!(error.to_string().contains("1000") && error.to_string().contains("fluid.max_particles"));
    // While it runs, too: a spacing that needs more is refused, and the fluid goes on.
    config.settings.max_particles = 1000;
    let mut run = Run::new(&config);
    let (count, mut finer) = (run.frame().particles, config.clone());
    finer.settings.spacing = 1e-4;
    assert!(matches!(run.fluid.configure(&finer), Err(FluidError::TooManyParticles { .. })));
    assert_eq!(run.frame().particles, count);
}

#[test]
fn the_ground_carries_the_water() {
    for solver in SOLVERS {
        for spacing in [0.005, 0.004] {
            let mut config = free_jet(solver, spacing);
            config.world.ground = Some(-0.02);
            config.world.bounds = aabb([-0.1, -0.04, -0.1], [0.1, 0.1, 0.1]);
            let mut run = Run::new(&config);
            run.run(0.4);
            let view = run.snapshot();
            assert_finite(&view, "ground");
            let lowest = view.positions.iter().map(|p| f64::from(p[1])).fold(f64::INFINITY, f64::min);
            assert!(lowest > -0.02 - 0.26 * spacing, "{solver:?}, dx {spacing} m: {lowest} m");
            // It spreads to all sides, and no side more than another.
            let rim: Vec<_> = view.positions.iter().map(vector).filter(|p| p.x.hypot(p.z) > 0.05).collect();
            let centre = rim.iter().sum::<DVec3>() / rim.len() as f64;
            assert!(rim.len() > 20, "{solver:?}, dx {spacing} m: it must spread");
            assert!(centre.x.hypot(centre.z) < 0.01, "{solver:?}, dx {spacing} m: it runs to {centre}");
        }
    }
}
