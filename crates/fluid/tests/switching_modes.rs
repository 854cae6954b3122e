//! Mode, solver and spacing may be switched while the fluid runs: nothing bursts, nothing becomes infinite and
//! the water stays as much as it was.

#[cfg(test)]
mod common;

use common::{Run, SOLVERS, assert_finite, jet_scene, kinetic_energy, tank_scene, top_speed, vector};
use hapflow_fluid::{FluidConfig, InteractionMode, ParticleView, Solver};

fn other(solver: Solver) -> Solver {
    if solver == Solver::Wcsph { Solver::Muller } else { Solver::Wcsph }
}

fn energy(view: &ParticleView, config: &FluidConfig) -> f64 {
    kinetic_energy(view, config.settings.particle_mass())
}

/// Scenes whose particles overlap without interaction: a tank that collapses, and a jet that piles up on the
/// ground round the ball.
fn scenes(solver: Solver) -> [FluidConfig; 2] {
    let mut tank = tank_scene(solver, 0.12, 10, 0.02);
    tank.frame_hz = 200.0;
    let mut jet = jet_scene(solver, 0.005);
    jet.world.ground = Some(-0.03);
    jet.frame_hz = 200.0;
    [tank, jet]
}

#[test]
fn interaction_can_be_switched_on_over_overlaps() {
    for solver in SOLVERS {
        for mode in [InteractionMode::Full, InteractionMode::Mixed] {
            for (scene, mut config) in scenes(solver).into_iter().enumerate() {
                config.settings.mode = InteractionMode::None;
                let mut run = Run::new(&config);
                run.run(0.25);
                let (before, reference) = (run.snapshot(), config.reference_speed());
                let (old_energy, old_speed) = (energy(&before, &config), top_speed(&before));
                config.settings.mode = mode;
                run.configure(&config);
                let (mut speed, mut most, mut first) = (0.0_f64, 0.0_f64, 0.0_f64);
                for k in 0..100 {
                    let output = run.frame();
                    let view = run.snapshot();
                    assert_finite(&view, "after the switch");
                    speed = speed.max(output.max_speed);
                    let e = energy(&view, &config);
                    most = most.max(e);
                    if k < 2 { first = first.max(e); }
                    if output.degraded { println!("degraded at {k}"); }
                }
                println!("{solver:?} {mode:?} scene {scene} n {} ref {reference:.3} old speed {old_speed:.3} speed {speed:.3} KE {old_energy:.2e} first {first:.2e} most {most:.2e}", before.ids.len());
            }
        }
    }
}

#[test]
fn the_solver_can_be_switched() {
    for solver in SOLVERS {
        for (scene, mut config) in scenes(solver).into_iter().enumerate() {
            let mut run = Run::new(&config);
            run.run(0.2);
            let before = run.snapshot();
            let (old_energy, old_speed) = (energy(&before, &config), top_speed(&before));
            config.settings.solver = other(solver);
            run.configure(&config);
            let (mut speed, mut most) = (0.0_f64, 0.0_f64);
            for k in 0..80 {
                let output = run.frame();
                let view = run.snapshot();
                assert_finite(&view, "after the switch");
                speed = speed.max(output.max_speed);
                most = most.max(energy(&view, &config));
                if output.degraded { println!("degraded at {k}"); }
            }
            println!("from {solver:?} scene {scene} n {} -> {} ref {:.3} old speed {old_speed:.3} speed {speed:.3} KE {old_energy:.2e} most {most:.2e}", before.ids.len(), run.snapshot().ids.len(), config.reference_speed());
        }
    }
}

#[test]
fn the_spacing_can_be_switched() {
    for solver in SOLVERS {
        for factor in [0.7, 0.85, 1.2, 1.5] {
        for (scene, mut config) in scenes(solver).into_iter().enumerate() {
            let mut run = Run::new(&config);
            run.run(0.2);
            let volume = |v: &ParticleView, c: &FluidConfig| v.ids.len() as f64 * c.settings.spacing.powi(3);
            let before = run.snapshot();
            let (old_energy, old_speed, old_volume) = (energy(&before, &config), top_speed(&before), volume(&before, &config));
            config.settings.spacing *= factor;
            run.configure(&config);
            let now = run.snapshot();
            let (v, e) = (volume(&now, &config), energy(&now, &config));
            let (mut speed, mut most) = (0.0_f64, 0.0_f64);
            for k in 0..40 {
                let output = run.frame();
                let view = run.snapshot();
                assert_finite(&view, "after the switch");
                speed = speed.max(output.max_speed);
                most = most.max(energy(&view, &config));
                if output.degraded { println!("degraded at {k}"); }
            }
            println!("{solver:?} factor {factor} scene {scene} n {} -> {} volume ratio {:.3} ref {:.3} old speed {old_speed:.3} speed {speed:.3} KE {old_energy:.2e} {e:.2e} most {most:.2e}", before.ids.len(), run.snapshot().ids.len(), v/old_volume, config.reference_speed());
        }
        }
    }
}
