//! The virtual clock: the same each time, on any number of threads, and with no look ahead.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{jet, word};
use hapflow::engine::run::{Outcome, RunOptions, virtual_clock};
use hapflow::engine::{Parts, Scene, Value, load, settings};
use std::ops::ControlFlow;

fn run(scene: &Scene, threads: usize) -> Outcome {
    let mut progress = |_: hapflow::engine::run::Progress<'_>| ControlFlow::Continue(());
    virtual_clock(
        scene,
        RunOptions {
            parts: Parts::default(),
            threads,
            pictures_at: &[0.25],
            record: None,
            guide: &mut |_| ControlFlow::Continue(()),
            progress: &mut progress,
        },
    )
    .unwrap()
}

#[test]
fn runs_are_bit_for_bit_the_same_on_1_2_3_and_8_threads() {
    for solver in ["wcsph", "muller"] {
        let scene = jet(&[("fluid.solver", word(solver)), ("run.device", word("hand"))]);
        let first = run(&scene, 1);
        assert!(first.recording.rows.iter().any(|r| r.sent.force.length() > 0.01), "nothing was felt");
        for threads in [1, 2, 3, 8] {
            let other = run(&scene, threads);
            assert_eq!(other.recording.rows, first.recording.rows, "{solver} on {threads} threads");
            assert_eq!(other.pictures[0].particles, first.pictures[0].particles);
        }
    }
}

#[test]
fn a_model_comes_one_whole_frame_after_its_path_ended() {
    // 60 Hz does not divide 1 kHz: frames end between ticks.
    for hz in [60.0, 100.0, 250.0] {
        let scene = jet(&[("run.backend", word("analytic-jet")), ("run.fluid_hz", Value::Number(hz))]);
        for row in &run(&scene, 1).recording.rows {
            let ended = (row.time_s * hz + 1e-6).floor() as u64;
            assert_eq!(row.frame, ended.saturating_sub(1), "{hz} Hz at {} s", row.time_s);
        }
    }
}

#[test]
fn scheduled_changes_act_at_their_time() {
    let text = format!("{}\n[[change]]\nat_s = 0.15\nsource.tap.on = false\n", common::JET);
    let mut scene = hapflow::engine::parse(&text, "jet").unwrap();
    settings::set(&mut scene, "run.backend", &word("analytic-jet")).unwrap();
    settings::set(&mut scene, "run.coupling", &word("direct")).unwrap();
    let rows = run(&scene, 1).recording.rows;
    let felt = |t: f64| rows[(t * 1000.0) as usize].raw.force.length();
    // Frames of 10 ms, published one later: the change is in the frame that ends at 0.15 s, seen from 0.16 s.
    assert!(felt(0.155) > 0.1 && felt(0.159) > 0.1);
    assert_eq!(felt(0.165), 0.0);
}

#[test]
fn shipped_scenes_run() {
    for (name, _) in hapflow::engine::shipped() {
        let mut scene = load(name).unwrap();
        settings::set(&mut scene, "run.duration", &Value::Number(0.15)).unwrap();
        let outcome = run(&scene, 2);
        // A spout has given less than a pool or a tap by then.
        let least = if *name == "pour" { 30 } else { 100 };
        assert!(outcome.recording.rows.len() == 150 && outcome.fluid.particles > least, "{name}");
        assert!(outcome.faults.is_empty(), "{name}: {}", outcome.faults);
        assert_eq!(outcome.fluid.degraded, 0, "{name}");
    }
}
