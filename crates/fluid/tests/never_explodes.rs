//! No setting makes the fluid explode: it is refused by name, or it stays finite, in its bounds, in its container
//! and below the guard on speeds, also while a tool jumps and tears through it.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, assert_finite, tank_scene, top_speed, vector};
use glam::DVec3;
use hapflow_fluid::{BodyDrive, BodyMotion, BodySample, CpuBackend, FluidBackend, FluidConfig, FluidError, FrameInput, FrameOutput, InteractionMode, Solver};

/// A tank of a few particles on an edge at these settings.
fn harsh(solver: Solver, spacing: f64, viscosity: f64, stiffness: f64, hz: f64) -> FluidConfig {
    let cells = 7;
    let mut config = tank_scene(solver, spacing * f64::from(cells), cells, 1.2 * spacing);
    config.settings.viscosity = viscosity;
    config.settings.stiffness = stiffness;
    config.frame_hz = hz;
    config
}

/// The highest speed that the last guard lets through, m/s.
fn guard(config: &FluidConfig) -> f64 {
    config.sound_speed().max(5.0 * config.reference_speed())
}

fn assert_sound(run: &mut Run, output: &FrameOutput, what: &str) {
    let (view, bounds, limit) = (run.snapshot(), run.config.world.bounds, guard(&run.config));
    assert_finite(&view, what);
    assert!(output.loads.iter().all(|l| l.force().is_finite() && l.torque.is_finite()), "{what}: load");
    assert!(top_speed(&view) <= 1.001 * limit, "{what}: {} m/s past the guard at {limit}", top_speed(&view));
    // A particle that has just left is dropped when the next sub-step begins.
    let slack = DVec3::splat(limit / run.config.frame_hz);
    let inside = |p: &[f32; 3]| {
        let p = vector(p);
        p.cmpge(bounds.min - slack).all() && p.cmple(bounds.max + slack).all()
    };
    assert!(view.positions.iter().all(inside), "{what}: out of bounds");
}

/// The message must say what is too high, how much it needs, and what is allowed.
fn assert_too_stiff(error: &FluidError, what: &str) {
    let FluidError::TooStiff { needed, allowed, .. } = *error else { panic!("{what}: {error}") };
    let text = error.to_string();
    assert!(needed > allowed, "{what}: {text}");
    for word in [&needed.to_string(), &allowed.to_string(), "fluid.max_substeps", "run.fluid_hz", "fluid.spacing"] {
        assert!(text.contains(word), "{what}: no {word} in: {text}");
    }
}

#[test]
fn every_setting_is_refused_or_rests() {
    let (mut tried, mut refused) = (0, 0);
    for (solver, stiffnesses) in [(Solver::Wcsph, &[100.0][..]), (Solver::Muller, &[1.0, 100.0, 1e4])] {
        for (spacing, viscosity) in [(0.003, 0.0), (0.003, 1.0), (0.003, 100.0), (0.02, 0.0), (0.02, 1.0), (0.02, 100.0)]
        {
            for &stiffness in stiffnesses {
                for hz in [30.0, 1000.0] {
                    let config = harsh(solver, spacing, viscosity, stiffness, hz);
                    let what = format!("{solver:?}, dx {spacing}, mu {viscosity}, k {stiffness}, {hz} Hz");
                    tried += 1;
                    match CpuBackend::new(&config) {
                        Ok(_) => rest(&config, &what),
                        Err(error) => {
                            refused += 1;
                            assert_too_stiff(&error, &what);
                        }
                    }
                }
            }
        }
    }
    println!("{tried} {refused}");
    assert!(refused > 0 && refused < tried / 4, "{refused} of {tried} were refused");
}

/// A tank at rest stays whole and calm.
fn rest(config: &FluidConfig, what: &str) {
    let mut run = Run::new(config);
    let count = run.snapshot().ids.len();
    for _ in 0..(0.06 * config.frame_hz).ceil() as usize {
        let output = run.frame();
        assert_sound(&mut run, &output, what);
        assert!(!output.degraded, "{what}: the last guard had to help");
        assert_eq!(output.particles, count, "{what}: the tank leaks");
    }
}

#[test]
fn a_tank_does_not_leak() {
    for solver in SOLVERS {
        for mode in [InteractionMode::Full, InteractionMode::Mixed, InteractionMode::None] {
            for cells in [7, 9] {
                let mut config = tank_scene(solver, 0.1, cells, 0.02);
                config.settings.mode = mode;
                let mut run = Run::new(&config);
                let count = run.snapshot().ids.len();
                let output = run.run(1.0);
                let what = format!("{solver:?}, {mode:?}, {cells} cells");
                assert_sound(&mut run, &output, &what);
                assert_eq!(output.particles, count, "{what}");
                let inner = config.world.container.unwrap().inner;
                let view = run.snapshot();
                let out = view.positions.iter().filter(|p| !inner.contains(vector(p))).count();
                println!("{what}: out {out} top {}", top_speed(&view));
                assert_eq!(out, 0, "{what}: particles stand in the walls");
            }
        }
    }
}

/// A tool that goes to and fro through the walls at 5 m/s, and now and then jumps.
fn wild(k: u32, dt: f64) -> [BodySample; 2] {
    let at = |t: f64| {
        let phase = 5.0 * t / 0.1;
        BodySample {
            time: t,
            velocity: DVec3::X * 5.0 * phase.cos(),
            ..BodySample::at(DVec3::new(0.1 * phase.sin(), 0.05, 0.0))
        }
    };
    let (mut a, mut b) = (at(f64::from(k) * dt), at(f64::from(k + 1) * dt));
    if k % 7 == 6 {
        // Elsewhere at once.
        b.position = DVec3::new(-0.3 * b.position.x, 0.02, 0.03);
        a.position = b.position;
    }
    [a, b]
}

#[test]
fn a_wild_tool_breaks_nothing() {
    for solver in SOLVERS {
        for mode in [InteractionMode::Full, InteractionMode::Mixed, InteractionMode::None] {
            for hz in [30.0, 200.0] {
                let mut config = tank_scene(solver, 0.1, 8, 0.025);
                config.settings.mode = mode;
                config.frame_hz = hz;
                let what = format!("{solver:?}, {mode:?}, {hz} Hz");
                let (mut run, mut top, mut degraded) = (Run::new(&config), 0.0_f64, 0);
                let count = run.snapshot().ids.len();
                for k in 0..(0.3 * hz) as u32 {
                    let output = run.frame_with(BodyDrive::Led, &wild(k, 1.0 / hz));
                    assert_sound(&mut run, &output, &what);
                    top = top.max(output.max_speed); degraded += u32::from(output.degraded);
                }
                // Once the tool is gone, what is left comes to rest.
                let far = [BodySample::at(DVec3::new(0.0, 0.25, 0.0))];
                let mut last = FrameOutput::default();
                for _ in 0..(0.7 * hz) as u32 {
                    last = run.frame_with(BodyDrive::Led, &far);
                    assert_sound(&mut run, &last, &what);
                }
                println!("{what}: guard {} top {top} degraded {degraded} count {count} -> {} last {} {}", guard(&config), last.particles, last.max_speed, last.degraded);
            }
        }
    }
}

#[test]
fn a_light_float_breaks_nothing() {
    for solver in SOLVERS {
        for mass in [1e-4, 1e-3, 1e-2, 0.1] {
            let mut config = tank_scene(solver, 0.1, 8, 0.02);
            config.world.bodies[0].mass = mass;
            let mut run = Run::new(&config);
            let what = format!("{solver:?}, {mass} kg");
            let mut state = BodySample::at(DVec3::Y * 0.05);
            let mut top = 0.0_f64; let mut deg=0; let mut ball=0.0_f64;
            for _ in 0..50 {
                // The hand's part: the ball's own weight.
                state.velocity += config.settings.gravity / config.frame_hz;
                let output = run.frame_with(BodyDrive::Driven { velocity: state.velocity }, &[BodySample::at(state.position)]);
                state = output.bodies[0];
                assert!(state.position.is_finite(), "{what}");
                top = top.max(output.max_speed); deg += u32::from(output.degraded);
                ball = ball.max(state.velocity.length());
                assert_sound(&mut run, &output, &what);
            }
            println!("{what}: guard {} top {top} ball {ball} deg {deg} n {} end y {}", guard(&config), run.snapshot().ids.len(), state.position.y);
        }
    }
}

#[test]
fn a_broken_sample_does_not_cost_the_water() {
    for solver in SOLVERS {
        for bad in [f64::NAN, f64::INFINITY, 1e30] {
            let mut run = Run::new(&tank_scene(solver, 0.1, 8, 0.02));
            let before = run.run(0.02).particles;
            let broken = BodySample { velocity: DVec3::splat(bad), ..BodySample::at(DVec3::splat(bad)) };
            let output = run.frame_with(BodyDrive::Led, &[broken]);
            let after = run.run(0.02);
            println!("{solver:?} {bad}: {before} -> {} {} deg {} {:?} {:?}", output.particles, after.particles, output.degraded, output.loads[0].force(), after.loads[0].force());
        }
    }
}

#[test]
fn no_time_no_load() {
    for solver in SOLVERS {
        let config = tank_scene(solver, 0.1, 8, 0.02);
        let mut run = Run::new(&config);
        run.run(0.1);
        let path=[BodySample::at(config.world.bodies[0].position)];
        let motion = [BodyMotion{drive:BodyDrive::Led,path:&path}];
        run.fluid.submit(&FrameInput{duration:0.0,bodies:&motion});
        let o=run.fluid.poll().unwrap().clone();
        println!("{solver:?} {:?} {}", o.loads[0].force(), o.particles);
    }
}
