//! The standalone demo with a Falcon, from power-on to summary: the emulated one, on a virtual clock.
#![allow(clippy::unwrap_used, clippy::panic)]

use glam::DVec3;
use hapflow::devices::Segment;
use hapflow::engine::run::{Outcome, Progress, RunOptions, virtual_clock};
use hapflow::engine::{Parts, Scene, SceneError, Value, load, settings};
use std::ops::ControlFlow;
use std::path::PathBuf;

/// An image as the real ones are built, of nothing in particular.
fn firmware(name: &str) -> PathBuf {
    let mut words: Vec<u16> = vec![0x08AA];
    words.extend([0; 8]);
    words.extend([0x3F, 0x8002, 700, 0x3F, 0x8002]);
    words.extend(0..700);
    words.push(0);
    let path = std::env::temp_dir().join(format!("hapflow-{name}-{}.bin", std::process::id()));
    std::fs::write(&path, words.into_iter().flat_map(u16::to_le_bytes).collect::<Vec<_>>()).unwrap();
    path
}

fn scene(name: &str, changes: &[(&str, Value)]) -> Scene {
    let mut scene = load("tap").unwrap();
    let firmware = firmware(name).to_string_lossy().into_owned();
    let text = |word: &str| Value::Text(word.into());
    let all = [
        ("run.device", text("emulated-falcon")),
        ("run.backend", text("analytic-jet")),
        ("falcon.firmware", Value::Text(firmware)),
    ];
    for (path, value) in all.iter().chain(changes) {
        settings::set(&mut scene, path, value).unwrap();
    }
    scene
}

/// What was told, and what came of it.
fn run(scene: &Scene, go_on: impl Fn(&str) -> bool) -> (Vec<String>, Result<Outcome, SceneError>) {
    let mut told: Vec<String> = Vec::new();
    let mut guide = |text: &str| {
        if told.last().is_none_or(|last| last != text) {
            told.push(text.to_owned());
        }
        if go_on(text) { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let mut progress = |_: Progress<'_>| ControlFlow::Continue(());
    let options = RunOptions {
        parts: Parts::default(),
        threads: 1,
        pictures_at: &[],
        record: None,
        guide: &mut guide,
        progress: &mut progress,
    };
    let outcome = virtual_clock(scene, options);
    (told, outcome)
}

#[test]
fn from_power_on_to_summary() {
    let (told, outcome) = run(&scene("demo", &[]), |_| true);
    assert_eq!(told[0], "loading firmware, attempt 1 of 10");
    assert!(told[1].starts_with("pull the grip all the way out, then push it straight in; marks: top -"));
    assert!(told[2].contains("found"), "{told:?}");
    assert_eq!(told.last().unwrap(), "homed");
    let outcome = outcome.unwrap();
    assert!(outcome.faults.latching().is_empty(), "{}", outcome.faults);
    assert!((outcome.timing.simulated_s - 6.5).abs() < 0.01, "{}", outcome.timing.simulated_s);
    let rows = &outcome.recording.rows;
    // The device sets the pace, at just over 1 kHz.
    assert!((6_400..6_600).contains(&rows.len()), "{} ticks", rows.len());
    // Half a second of ramp, then the jet's force on the ball, down.
    let ramp = rows.iter().filter(|row| row.time_s < 0.5);
    ramp.for_each(|row| assert!(row.sent.force.length() <= 4.0 * row.time_s / 0.5 + 0.01));
    let held: Vec<_> = rows.iter().filter(|row| (1.8..2.0).contains(&row.time_s)).collect();
    assert!(held.iter().all(|row| row.sent.force.y < -0.1), "{:?}", held.first());
    // The hand crosses the jet as its script says, within the Falcon's reach.
    let widest = rows.iter().map(|row| row.tool.position.x.abs()).fold(0.0, f64::max);
    assert!((widest - 0.055).abs() < 0.005, "{widest}");
}

/// Two runs are the same to the bit, the device's exchange included.
#[test]
fn it_repeats_to_the_bit() {
    let scene = scene("repeat", &[("run.duration", Value::Number(0.5))]);
    let forces = || -> Vec<_> {
        let rows = run(&scene, |_| true).1.unwrap().recording.rows;
        rows.iter().map(|row| (row.time_s.to_bits(), row.sent.force.to_array().map(f64::to_bits))).collect()
    };
    assert_eq!(forces(), forces());
}

#[test]
fn the_weight_of_the_grip_is_carried_within_the_gate() {
    let mass = ("mapping.carried_mass", Value::Number(0.12));
    let high = ("tool.position", Value::Vector(DVec3::new(0.1, 0.1, 0.1)));
    let duration = ("run.duration", Value::Number(0.8));
    let lift = |more: &[(&str, Value)]| {
        let changes = [&[mass.clone(), high.clone(), duration.clone()], more].concat();
        let rows = run(&scene("weight", &changes), |_| true).1.unwrap().recording.rows;
        (rows[0].sent.force.y, rows.last().unwrap().sent.force.y)
    };
    let (first, last) = lift(&[]);
    assert!(first < 0.01 && (last - 0.12 * 9.80665).abs() < 1e-6, "{first} then {last}");
    let (_, last) = lift(&[("gate.max_force", Value::Number(0.5))]);
    assert!((last - 0.5).abs() < 1e-6, "{last}");
}

/// Where the Falcon's arms reach no further a soft rim pushes back, before they stop the hand.
#[test]
fn the_edge_of_its_workspace_is_soft() {
    let mut scene =
        scene("rim", &[("run.duration", Value::Number(5.0)), ("source.tap.on", Value::Bool(false))]);
    scene.script = vec![Segment::MoveTo { position: DVec3::X * 0.075, duration_s: 2.0 }];
    let rows = run(&scene, |_| true).1.unwrap().recording.rows;
    let last = rows.last().unwrap();
    assert!(last.tool.position.x > 0.062, "{}", last.tool.position);
    assert!(last.sent.force.x < -0.5, "{}", last.sent.force);
    let inside = rows.iter().filter(|row| row.tool.position.x.abs() < 0.055 && row.tool.position.z < 0.02);
    inside.for_each(|row| assert!(row.sent.force.x.abs() < 0.01, "{row:?}"));
}

#[test]
fn giving_up_while_homing_is_told() {
    let (_, outcome) = run(&scene("given-up", &[]), |text| !text.starts_with("pull"));
    assert_eq!(outcome.unwrap_err().to_string(), "device: stopped before the Falcon was homed");
}

/// A device in a hand cannot go as fast as it can.
#[test]
fn a_real_one_has_no_virtual_clock() {
    let (_, outcome) = run(&scene("real", &[("run.device", Value::Text("falcon".into()))]), |_| true);
    assert!(outcome.unwrap_err().to_string().contains("a device in a hand runs in real time only"));
}
