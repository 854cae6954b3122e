//! Couplings against the balance of momentum over the particles: whatever momentum the falling jet loses beyond
//! gravity, the tool has taken. The balance is made of snapshots alone and knows nothing of loads.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{jet, open, word};
use glam::DVec3;
use hapflow::engine::{Scene, Value};
use hapflow::fluid::ParticleView;
use hapflow::haptics::ToolState;
use std::collections::HashMap;

/// Mean force on the hand and by the balance, N, from `from_s` to `to_s`.
fn forces(scene: &Scene, from_s: f64, to_s: f64) -> (DVec3, DVec3) {
    let mut session = open(scene, 2);
    let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
    let (hz, mass) = (scene.run.fluid_hz, scene.fluid.particle_mass());
    let (mut before, mut after) = (ParticleView::default(), ParticleView::default());
    let (mut felt, mut balance, mut frames) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for k in 1..=(to_s * hz) as usize {
        let end = k as f64 / hz;
        fluid.snapshot(&mut before);
        fluid.publish(end);
        fluid.compute(end);
        fluid.snapshot(&mut after);
        for n in 0..(1000.0 / hz) as usize {
            let time = end + n as f64 * 1e-3;
            servo.tick(&ToolState::at(scene.tool.position), time, 1e-3);
        }
        if end > from_s {
            // What the servo feels now is the frame before; in the mean over many frames it does not matter.
            felt += servo.newest().raw.force;
            balance += taken(scene, &before, &after, mass, 1.0 / hz);
            frames += 1.0;
        }
    }
    (felt / frames, balance / frames)
}

/// Momentum that the particles alive before and after lost beyond gravity, per time. Over its first two
/// spacings the source leads a particle, and gravity does not act on it.
fn taken(scene: &Scene, before: &ParticleView, after: &ParticleView, mass: f64, dt: f64) -> DVec3 {
    let source = &scene.sources[0];
    let old: HashMap<u32, usize> = before.ids.iter().enumerate().map(|(i, id)| (*id, i)).collect();
    let mut force = DVec3::ZERO;
    for (j, id) in after.ids.iter().enumerate() {
        let Some(&i) = old.get(id) else { continue };
        let travelled = source.position.y - f64::from(before.positions[i][1]);
        let led = ((2.0 * scene.fluid.spacing - travelled) / source.speed).clamp(0.0, dt);
        let change =
            (glam::Vec3::from(after.velocities[j]) - glam::Vec3::from(before.velocities[i])).as_dvec3();
        force -= (change / dt - scene.fluid.gravity * (1.0 - led / dt)) * mass;
    }
    force
}

fn scene(solver: &str, coupling: &str, response: f64, spacing: f64) -> Scene {
    jet(&[
        ("fluid.solver", word(solver)),
        ("run.coupling", word(coupling)),
        ("tool.collision_response", Value::Number(response)),
        ("fluid.restitution", Value::Number(0.0)),
        ("fluid.spacing", Value::Number(spacing)),
    ])
}

#[test]
fn direct_renders_the_balance() {
    for (solver, spacing) in [("wcsph", 0.006), ("wcsph", 0.005), ("muller", 0.006)] {
        let (felt, balance) = forces(&scene(solver, "direct", 0.2, spacing), 0.25, 0.75);
        println!("{solver} dx {spacing}: felt {felt}, balance {balance}");
        assert!(balance.y < -0.05, "the jet must push down: {balance}");
        assert!((felt.y / balance.y - 1.0).abs() < 0.1, "{solver} at {spacing}: {felt} against {balance}");
        assert!((felt - balance).length() < 0.1 * balance.length());
    }
}

#[test]
fn momentum_renders_its_share_of_the_balance() {
    for (solver, spacing) in [("wcsph", 0.006), ("muller", 0.006), ("muller", 0.005)] {
        for response in [1.0, 0.2] {
            let (felt, balance) = forces(&scene(solver, "momentum", response, spacing), 0.25, 0.75);
            println!("{solver} dx {spacing} C_R {response}: felt {felt}, balance {balance}");
            assert!(balance.y < -0.05);
            let share = felt.y / balance.y / response;
            assert!((share - 1.0).abs() < 0.3, "{solver}, C_R {response}: {felt} against {balance}");
        }
    }
}

#[test]
fn both_couplings_render_the_closed_form_jet() {
    for (coupling, response, share) in [("direct", 0.2, 1.0), ("momentum", 1.0, 1.0), ("momentum", 0.2, 0.2)]
    {
        let mut scene = scene("wcsph", coupling, response, 0.006);
        hapflow::engine::settings::set(&mut scene, "run.backend", &word("analytic-jet")).unwrap();
        let mut session = open(&scene, 1);
        let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
        for k in 1..50 {
            fluid.publish(f64::from(k) * 0.01);
            fluid.compute(f64::from(k) * 0.01);
            servo.tick(&ToolState::default(), f64::from(k) * 0.01, 1e-3);
        }
        let tap = &scene.sources[0];
        let expected =
            hapflow::fluid::jet_force(tap, 1000.0, scene.fluid.gravity, 0.015, DVec3::ZERO, DVec3::ZERO);
        let felt = servo.newest().raw.force;
        // The driven body yields a little within a frame, and the jet there is a little slower or faster.
        assert!((felt - expected * share).length() < 0.05 * expected.length() * share, "{coupling}: {felt}");
    }
}
