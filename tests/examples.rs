//! The Rust examples are built and run.
#![allow(clippy::unwrap_used, clippy::panic)]

use hapflow::engine::run::{RunOptions, virtual_clock};
use hapflow::engine::{Parts, Value, load, settings};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A small tap, and how it is said on a command line.
const COARSE: [&str; 4] =
    ["run.duration=0.4", "run.backend=analytic-jet", "gate.ramp_in=0", "tool.force_scale=3"];

/// Runs an example, built with this test's profile into its own target directory.
fn example(name: &str, words: &[&str]) -> Output {
    let test = std::env::current_exe().unwrap();
    let profile = test.parent().and_then(Path::parent).unwrap();
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(env!("CARGO_MANIFEST_DIR")).args([
        "run",
        "--quiet",
        "-p",
        "hapflow",
        "--example",
        name,
    ]);
    match profile.file_name().and_then(|p| p.to_str()).unwrap() {
        "debug" => {}
        other => drop(cargo.args(["--profile", other])),
    }
    cargo.arg("--target-dir").arg(profile.parent().unwrap()).arg("--").args(words).output().unwrap()
}

/// Time and force of each tick that an example printed.
fn printed(output: &Output) -> Vec<[f64; 4]> {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time_s,fx_N,fy_N,fz_N"));
    let row = |line: &str| -> Vec<f64> { line.split(',').map(|n| n.parse().unwrap()).collect() };
    lines.map(|line| row(line).try_into().unwrap()).collect()
}

/// The same run in this process; with its ticks in a file.
fn run(record: &Path) -> Vec<[f64; 4]> {
    let mut scene = load("tap").unwrap();
    for word in COARSE.iter().chain(&["run.device=replay"]) {
        let (path, value) = word.split_once('=').unwrap();
        settings::set(&mut scene, path, &Value::parse(value)).unwrap();
    }
    let mut go_on = |_: hapflow::engine::run::Progress<'_>| ControlFlow::Continue(());
    let options = RunOptions {
        parts: Parts::default(),
        threads: 1,
        pictures_at: &[],
        record: Some(record),
        guide: &mut |_| ControlFlow::Continue(()),
        progress: &mut go_on,
    };
    let rows = virtual_clock(&scene, options).unwrap().recording.rows;
    rows.iter().map(|r| [r.time_s, r.sent.force.x, r.sent.force.y, r.sent.force.z]).collect()
}

fn recording() -> PathBuf {
    std::env::temp_dir().join(format!("hapflow-replay-{}.csv", std::process::id()))
}

#[test]
fn replay_prints_what_a_recorded_hand_feels() {
    let file = recording();
    let expected = run(&file);
    let by_name = printed(&example("replay", &[&["tap", "tremor"][..], &COARSE].concat()));
    assert_eq!(by_name, expected);
    assert!(expected.last().unwrap()[2] < -0.3, "nothing was felt");
    // What was recorded is played from where it was: the same places, and so about the same forces.
    let path = file.display().to_string();
    let again = example("replay", &[&["tap", &path, "run.motion_origin=scene"][..], &COARSE].concat());
    for (a, b) in printed(&again).iter().zip(&expected) {
        assert!((a[2] - b[2]).abs() < 0.01, "{a:?} {b:?}");
    }
    std::fs::remove_file(file).unwrap();

    let wrong = example("replay", &["tap", "tremor", "fluid.viscosity=-1"]);
    let said = String::from_utf8_lossy(&wrong.stderr).into_owned();
    assert!(
        !wrong.status.success() && said.contains("fluid.viscosity") && said.contains("0 to 10000"),
        "{said}"
    );
}
