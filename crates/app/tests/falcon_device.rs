//! `hapflow falcon` and `hapflow run` with a Falcon that is emulated down to USB transfers, in real time.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn hapflow(words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hapflow")).args(words).output().unwrap()
}

fn told(output: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (text(&output.stdout), text(&output.stderr))
}

/// An image as the real ones are built, of nothing in particular.
fn firmware() -> PathBuf {
    let mut words: Vec<u16> = vec![0x08AA];
    words.extend([0; 8]);
    words.extend([0x3F, 0x8002, 700, 0x3F, 0x8002]);
    words.extend(0..700);
    words.push(0);
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("firmware.bin");
    std::fs::write(&path, words.into_iter().flat_map(u16::to_le_bytes).collect::<Vec<_>>()).unwrap();
    path
}

#[test]
fn an_image_is_loaded_and_a_wrong_one_is_not_sent() {
    let image = firmware();
    let output = hapflow(&["falcon", "firmware", image.to_str().unwrap(), "--emulated"]);
    let (out, err) = told(&output);
    assert!(output.status.success(), "{err}");
    assert!(out.contains("1430 bytes, entry 0x3f8002, 1 blocks\nloaded, and it answers"), "{out}");
    assert_eq!(err, "loading firmware, attempt 1 of 10\n");
    let wrong = hapflow(&["falcon", "firmware", env!("CARGO_BIN_EXE_hapflow"), "--emulated"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(told(&wrong).1.contains("it must be a C28x 8-bit boot stream"), "{wrong:?}");
}

#[test]
fn it_is_homed_tested_and_calibrated() {
    let output = hapflow(&["falcon", "test", "--seconds", "1", "--emulated"]);
    let (out, err) = told(&output);
    assert!(output.status.success(), "{err}");
    assert!(err.starts_with("pull the grip all the way out") && err.ends_with("homed\n"), "{err}");
    assert!(out.contains("\nrate ") && out.contains("\nline errors      0\n"), "{out}");
    // The emulated hand holds it in the middle, where the geometry says: the zero angles stay.
    let output = hapflow(&["falcon", "calibrate", "--at", "0,0,0.125", "--emulated"]);
    let (out, err) = told(&output);
    assert!(output.status.success(), "{err}");
    let zero = out.lines().find(|line| line.starts_with("zero_deg = [")).unwrap();
    let angles = zero.trim_start_matches("zero_deg = [").trim_end_matches(']').split(", ");
    for angle in angles.map(|angle| angle.parse::<f64>().unwrap()) {
        assert!((angle - 35.0).abs() < 0.05, "{zero}");
    }
}

#[test]
fn the_demo_runs_from_power_on_to_summary() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("demo");
    let image = format!("falcon.firmware={}", firmware().display());
    let words =
        ["run", "tap", "--device", "emulated-falcon", "--realtime", "--duration", "1", "--set", &image];
    let output = hapflow(
        &[&words[..], &["--set", "run.backend=analytic-jet", "--out", folder.to_str().unwrap()]].concat(),
    );
    let (out, err) = told(&output);
    assert!(output.status.success(), "{err}");
    let order =
        ["loading firmware", "pull the grip all the way out", "homed"].map(|text| err.find(text).unwrap());
    assert!(order.is_sorted(), "{err}");
    assert!(out.contains("mean force") && out.contains("late ticks"), "{out}");
    assert!(folder.join("summary.json").is_file());
}

/// As Ctrl-C does, a closed terminal, or a system that ends: the run ends by itself, with its results.
#[cfg(unix)]
#[test]
fn every_signal_that_ends_programs_ends_a_run_with_its_results() {
    let runs = ["INT", "TERM", "HUP"].map(|signal| (signal, endless(signal)));
    for (signal, mut run) in runs {
        let mut told = BufReader::new(run.stderr.take().unwrap()).lines();
        assert!(told.any(|line| line.unwrap() == "homed"));
        let sent = Command::new("kill").args([&format!("-{signal}"), &run.id().to_string()]).status();
        assert!(sent.unwrap().success());
        let output = run.wait_with_output().unwrap();
        assert!(output.status.success(), "{signal}: {output:?}");
        assert!(String::from_utf8(output.stdout).unwrap().contains("mean force"), "{signal}");
    }
}

/// A run that would go on for ten minutes.
#[cfg(unix)]
fn endless(name: &str) -> std::process::Child {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("ended-by-{name}"));
    let words = ["run", "tap", "--device", "emulated-falcon", "--realtime", "--duration", "600"];
    Command::new(env!("CARGO_BIN_EXE_hapflow"))
        .args(words)
        .args(["--set", "run.backend=analytic-jet", "--out", folder.to_str().unwrap()])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

#[test]
fn every_device_is_listed_with_what_it_can() {
    let listed: serde_json::Value = serde_json::from_slice(&hapflow(&["devices", "--json"]).stdout).unwrap();
    let devices = listed.as_array().unwrap();
    for name in ["null", "replay", "hand", "falcon", "emulated-falcon"] {
        let device = devices.iter().find(|device| device["name"] == name).unwrap();
        assert!(
            device["present"].is_boolean() && device["found"].as_str().is_some_and(|text| !text.is_empty())
        );
        assert!(device["hardware"].as_bool().unwrap() || device["present"].as_bool().unwrap());
        let numbers = [
            "sensed_dof",
            "driven_dof",
            "max_force_N",
            "max_stiffness_N_per_m",
            "max_damping_N_s_per_m",
            "rate_Hz",
        ];
        assert!(numbers.iter().all(|key| device[key].is_number()), "{device}");
        assert_eq!(device["workspace_m"].as_array().unwrap().len(), 3);
    }
    let (told, _) = told(&hapflow(&["devices"]));
    let falcon = "hardware, senses 3 and drives 3 degrees of freedom, up to 8 N, up to 3000 N/m, up to 20 N·s/m, over 100 x 100 x 100 mm, 1000 Hz";
    assert!(told.contains(falcon), "{told}");
}

/// Where there is no Falcon, it says so, and what to do.
#[test]
fn an_absent_one_is_told() {
    let output = hapflow(&["falcon", "info"]);
    let (_, err) = told(&output);
    if output.status.success() {
        println!("SKIPPED: a Falcon is plugged in");
        return;
    }
    assert_eq!(output.status.code(), Some(1));
    assert!(err.starts_with("hapflow: no ") && err.lines().count() == 1, "{err}");
    let unknown = hapflow(&["run", "tap", "--device", "falcn"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(told(&unknown).1.contains("unknown device \"falcn\": choose one of null, replay, hand, falcon"));
}
