//! A cup that is filled gets heavier by the weight of the water in it.
#![allow(clippy::unwrap_used, clippy::panic)]

use hapflow::engine::run::{Progress, RunOptions, virtual_clock};
use hapflow::engine::{Scene, Value, load, settings};
use std::ops::ControlFlow;

/// Mean force (N, down) on the hand from 2.9 to 3.4 s, when the water rests, and the weight of what is in the cup.
fn weights(scene: &Scene) -> [f64; 2] {
    let outcome = virtual_clock(
        scene,
        RunOptions {
            threads: 2,
            pictures_at: &[3.4],
            record: None,
            guide: &mut |_| ControlFlow::Continue(()),
            progress: &mut |_: Progress<'_>| ControlFlow::Continue(()),
            parts: hapflow::engine::Parts::default(),
        },
    )
    .unwrap();
    let rows = &outcome.recording.rows;
    let mean = |from: f64, to: f64| {
        let part: Vec<_> = rows.iter().filter(|r| r.time_s >= from && r.time_s < to).collect();
        part.iter().map(|r| -r.sent.force.y).sum::<f64>() / part.len() as f64
    };
    let picture = &outcome.pictures[0];
    let cup = picture.servo.tool.position;
    let within = |p: &[f32; 3]| {
        let [x, y, z] = [0, 1, 2].map(|k| f64::from(p[k]) - cup[k]);
        x.hypot(z) < 0.036 && y.abs() < 0.06
    };
    let inside = picture.particles.positions.iter().filter(|p| within(p)).count();
    let weight = inside as f64 * scene.fluid.particle_mass() * scene.fluid.gravity.length();
    println!("{} of {} particles in the cup", inside, picture.particles.positions.len());
    [mean(2.9, 3.4) - mean(0.0, 0.05), weight]
}

#[test]
fn a_cup_gets_heavier_by_what_is_poured_into_it() {
    let mut scene = load("pour").unwrap();
    settings::set(&mut scene, "run.duration", &Value::Number(3.5)).unwrap();
    let [felt, weight] = weights(&scene);
    println!("felt {felt:.4} N, the water weighs {weight:.4} N");
    assert!(weight > 0.8, "the cup is as good as empty: {weight} N");
    assert!((felt / weight - 1.0).abs() < 0.03, "{felt} N for {weight} N");
}
