//! No setting makes the fluid explode: it is refused by name, or it stays finite, in its bounds, in its container
//! and below the guard on speeds, also while a tool jumps and tears through it.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, assert_finite, tank_scene, top_speed, vector};
use glam::DVec3;
use hapflow_fluid::{
    BodyDrive, BodyMotion, BodySample, CpuBackend, FluidBackend, FluidConfig, FluidError, FrameInput,
    FrameOutput, InteractionMode, Shape, Solver,
};

const MODES: [InteractionMode; 3] = [InteractionMode::Full, InteractionMode::Mixed, InteractionMode::None];

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
    let text = error.to_string();
    let &FluidError::TooStiff { needed, allowed, .. } = error else {
        unreachable!("{what}: {text}");
    };
    assert!(needed > allowed, "{what}: {text}");
    for word in
        [&needed.to_string(), &allowed.to_string(), "fluid.max_substeps", "run.fluid_hz", "fluid.spacing"]
    {
        assert!(text.contains(word), "{what}: no {word} in: {text}");
    }
}

#[test]
fn every_setting_is_refused_or_rests() {
    let (mut tried, mut refused) = (0, 0);
    for (solver, stiffnesses) in [(Solver::Wcsph, &[100.0][..]), (Solver::Muller, &[1.0, 100.0, 1e4])] {
        for (spacing, viscosity) in
            [(0.003, 0.0), (0.003, 1.0), (0.003, 100.0), (0.02, 0.0), (0.02, 1.0), (0.02, 100.0)]
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
        for mode in MODES {
            for cells in [7, 9] {
                let mut config = tank_scene(solver, 0.1, cells, 0.02);
                config.settings.mode = mode;
                let mut run = Run::new(&config);
                let count = run.snapshot().ids.len();
                let output = run.run(0.8);
                let what = format!("{solver:?}, {mode:?}, {cells} cells");
                assert_sound(&mut run, &output, &what);
                assert_eq!(output.particles, count, "{what}");
                // The last stop of `wcsph` lies a quarter of a spacing behind a wall.
                let mut inner = config.world.container.unwrap().inner;
                inner.min -= 0.26 * config.settings.spacing;
                inner.max += 0.26 * config.settings.spacing;
                assert!(
                    run.snapshot().positions.iter().all(|p| inner.contains(vector(p))),
                    "{what}: in the walls"
                );
            }
        }
    }
}

#[test]
fn a_stirred_tank_does_not_leak() {
    for solver in SOLVERS {
        for cells in [7, 10] {
            let config = tank_scene(solver, 0.1, cells, 0.02);
            let mut run = Run::new(&config);
            let count = run.snapshot().ids.len();
            for k in 0..60 {
                let path = swing(k, 0.01, 0.02, 0.5);
                let output = run.frame_with(BodyDrive::Led, &path);
                assert_sound(&mut run, &output, "stirred");
                assert_eq!(output.particles, count, "{solver:?}, {cells} cells");
            }
        }
    }
}

/// One frame of a tool that goes to and fro along x, `reach` (m) to each side, at `speed` (m/s) in the middle.
fn swing(k: u32, dt: f64, reach: f64, speed: f64) -> [BodySample; 2] {
    let at = |t: f64| {
        let phase = speed * t / reach;
        BodySample {
            time: t,
            velocity: DVec3::X * speed * phase.cos(),
            ..BodySample::at(DVec3::new(reach * phase.sin(), 0.05, 0.0))
        }
    };
    [at(f64::from(k) * dt), at(f64::from(k + 1) * dt)]
}

/// A swing through the walls at 5 m/s; in every seventh frame the tool is elsewhere at once.
fn wild(k: u32, dt: f64) -> [BodySample; 2] {
    let [mut a, mut b] = swing(k, dt, 0.1, 5.0);
    if k % 7 == 6 {
        b.position = DVec3::new(-0.2 * b.position.x, 0.03, 0.0);
        a.position = b.position;
    }
    [a, b]
}

#[test]
fn a_wild_tool_breaks_nothing() {
    for solver in SOLVERS {
        for mode in MODES {
            for hz in [30.0, 200.0] {
                let mut config = tank_scene(solver, 0.1, 8, 0.025);
                config.settings.mode = mode;
                config.frame_hz = hz;
                let what = format!("{solver:?}, {mode:?}, {hz} Hz");
                let mut run = Run::new(&config);
                for k in 0..(0.3 * hz) as u32 {
                    let output = run.frame_with(BodyDrive::Led, &wild(k, 1.0 / hz));
                    assert_sound(&mut run, &output, &what);
                }
                // Once the tool is out, nothing moves faster than what falls out of the world.
                let out = [BodySample::at(DVec3::Y * 0.25)];
                let mut last = FrameOutput::default();
                for _ in 0..(0.7 * hz) as u32 {
                    last = run.frame_with(BodyDrive::Led, &out);
                    assert_sound(&mut run, &last, &what);
                }
                let bounds = config.world.bounds;
                let fall = (2.0 * 9.81 * (bounds.max.y - bounds.min.y)).sqrt();
                assert!(!last.degraded && last.max_speed < 1.5 * fall, "{what}: {} m/s", last.max_speed);
            }
        }
    }
}

/// A ball of `mass` that the water and its weight alone move.
fn float(solver: Solver, mass: f64) {
    let mut config = tank_scene(solver, 0.1, 8, 0.02);
    config.world.bodies[0].mass = mass;
    let mut run = Run::new(&config);
    let what = format!("{solver:?}, {mass} kg");
    let mut state = BodySample::at(DVec3::Y * 0.05);
    for _ in 0..40 {
        let velocity = state.velocity + config.settings.gravity / config.frame_hz;
        let output = run.frame_with(BodyDrive::Driven { velocity }, &[BodySample::at(state.position)]);
        state = output.bodies[0];
        assert!(
            state.velocity.length() < guard(&config),
            "{what}: the ball has {} m/s",
            state.velocity.length()
        );
        assert_sound(&mut run, &output, &what);
        assert!(!output.degraded, "{what}: the last guard had to help");
    }
}

#[test]
fn a_float_breaks_nothing() {
    for solver in SOLVERS {
        for mass in [0.01, 0.03, 0.1] {
            float(solver, mass);
        }
    }
}

#[test]
fn the_lightest_float_allowed_breaks_nothing() {
    let displaced = 1000.0 * Shape::Sphere { radius: 0.02 }.volume();
    for solver in SOLVERS {
        float(solver, hapflow_fluid::MIN_MASS_RATIO * displaced);
    }
}

#[test]
fn a_broken_sample_does_not_cost_the_water() {
    for solver in SOLVERS {
        for bad in [f64::NAN, f64::INFINITY, 1e30] {
            let mut run = Run::new(&tank_scene(solver, 0.1, 8, 0.02));
            let count = run.run(0.02).particles;
            let broken = BodySample { velocity: DVec3::splat(bad), ..BodySample::at(DVec3::splat(bad)) };
            for output in [run.frame_with(BodyDrive::Led, &[broken]), run.run(0.02)] {
                assert_sound(&mut run, &output, "broken sample");
                assert_eq!(output.particles, count, "{solver:?}: {bad} costs water");
            }
        }
    }
}

#[test]
fn a_frame_of_no_length_changes_nothing() {
    for solver in SOLVERS {
        let config = tank_scene(solver, 0.1, 8, 0.02);
        let mut run = Run::new(&config);
        let count = run.run(0.02).particles;
        let path = [BodySample::at(config.world.bodies[0].position)];
        let bodies = [BodyMotion { drive: BodyDrive::Led, path: &path }];
        run.fluid.submit(&FrameInput { duration: 0.0, bodies: &bodies });
        let output = run.fluid.poll().unwrap().clone();
        assert_sound(&mut run, &output, "no length");
        assert_eq!(output.particles, count, "{solver:?}");
    }
}

/// Changes to a scene, each of which must be refused for the field that it names.
type Refusal = (&'static str, fn(&mut FluidConfig));

const REFUSALS: [Refusal; 24] = [
    ("fluid.spacing", |c| c.settings.spacing = 0.0),
    ("fluid.spacing", |c| c.settings.spacing = -0.01),
    ("fluid.spacing", |c| c.settings.spacing = f64::NAN),
    ("fluid.support", |c| c.settings.support = 9.0),
    ("fluid.rest_density", |c| c.settings.rest_density = 0.0),
    ("fluid.viscosity", |c| c.settings.viscosity = -1.0),
    ("fluid.viscosity", |c| c.settings.viscosity = f64::INFINITY),
    ("fluid.surface_tension", |c| c.settings.surface_tension = -0.1),
    ("fluid.stiffness", |c| c.settings.stiffness = 1e7),
    ("fluid.cohesion", |c| c.settings.cohesion = 1.1),
    ("fluid.sound_speed", |c| c.settings.sound_speed = 1e4),
    ("fluid.density_diffusion", |c| c.settings.density_diffusion = 0.5),
    ("fluid.artificial_viscosity", |c| c.settings.artificial_viscosity = 2.0),
    ("fluid.acoustic_damping", |c| c.settings.acoustic_damping = -0.1),
    ("fluid.damping", |c| c.settings.damping = -1.0),
    ("fluid.max_displacement", |c| c.settings.max_displacement = -1.0),
    ("fluid.lifetime", |c| c.settings.lifetime = f64::NAN),
    ("fluid.gravity", |c| c.settings.gravity = DVec3::NAN),
    ("fluid.restitution", |c| c.settings.restitution = 1.5),
    ("run.fluid_hz", |c| c.frame_hz = 5000.0),
    ("tool.mass", |c| c.world.bodies[0].mass = 0.0),
    ("tool.collision_response", |c| c.world.bodies[0].collision_response = 1.2),
    ("tool.radius", |c| c.world.bodies[0].shape = Shape::Sphere { radius: 0.0 }),
    ("bounds", |c| c.world.bounds.max.y = c.world.bounds.min.y),
];

#[test]
fn a_refusal_names_field_value_and_range_and_leaves_the_fluid_running() {
    for solver in SOLVERS {
        let good = tank_scene(solver, 0.1, 7, 0.02);
        let (mut run, mut undisturbed) = (Run::new(&good), Run::new(&good));
        for (field, change) in REFUSALS {
            let mut bad = good.clone();
            change(&mut bad);
            let error = CpuBackend::new(&bad).unwrap_err();
            assert_eq!(run.fluid.configure(&bad).unwrap_err().to_string(), error.to_string(), "{field}");
            assert!(error.to_string().contains(field), "{field} is not in: {error}");
            if let FluidError::Range { field: named, value, min, max } = error {
                assert_eq!(named, field);
                assert!(!(min..=max).contains(&value), "{error}");
                let words = [value, min, max].map(|number| number.to_string());
                assert!(words.iter().all(|word| error.to_string().contains(word)), "{error}");
            }
        }
        run.run(0.05);
        undisturbed.run(0.05);
        assert!(run.snapshot() == undisturbed.snapshot(), "{solver:?}: a refusal left something behind");
    }
}
