//! `hapflow` with a Falcon at a USB that is not there: the program, unmodified libusb, and an emulated device behind umockdev's
//! preload library.
#![cfg(all(target_os = "linux", feature = "falcon"))]
#![allow(clippy::unwrap_used, clippy::panic)]

#[allow(dead_code)]
#[path = "../../devices/tests/usb/mod.rs"]
mod usb;

use glam::DVec3;
use hapflow_devices::Segment;
use hapflow_devices::falcon::{EmulatedFalcon, EmulatedHand, Geometry, Kinematics, Trouble};
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use usb::{Machine, SERIAL};

/// A machine with a Falcon whose firmware runs, in a hand that stirs; nothing where there is no umockdev.
///
/// One at a time: the driver's deadlines are real ones, and a machine may have few cores.
fn machine(name: &str) -> Option<(Machine, MutexGuard<'static, ()>)> {
    static ONE: Mutex<()> = Mutex::new(());
    let probe = Command::new("true").env("LD_PRELOAD", "libumockdev-preload.so.0").output().unwrap();
    if !probe.stderr.is_empty() {
        println!("SKIPPED: no umockdev (apt-get install umockdev)");
        return None;
    }
    let kinematics = Kinematics::new(Geometry::load("libnifalcon").unwrap());
    let stir = Segment::Sine { amplitude: DVec3::X * 0.02, frequency_hz: 0.5, duration_s: 1000.0 };
    let hand = EmulatedHand::new(kinematics, &[stir], true).unwrap();
    let alone = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    Some((Machine::new(name, EmulatedFalcon::new(hand, Trouble::default(), true)).unwrap(), alone))
}

fn hapflow(machine: &Machine, words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hapflow"));
    command.args(words).envs(machine.environment()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("usb-{name}"))
}

/// A run of the demo with the first real device, once its Falcon is homed; and what it told until then.
fn homed(
    machine: &Machine,
    folder: &Path,
    duration: &str,
) -> (Child, BufReader<std::process::ChildStderr>, String) {
    let words = [
        "run",
        "tap",
        "--device",
        "auto",
        "--duration",
        duration,
        "--set",
        "run.backend=analytic-jet",
        "--out",
    ];
    let mut run = hapflow(machine, &[&words[..], &[folder.to_str().unwrap()]].concat()).spawn().unwrap();
    let mut lines = BufReader::new(run.stderr.take().unwrap());
    let mut told = String::new();
    while !told.ends_with("homed\n") && lines.read_line(&mut told).unwrap() > 0 {}
    (run, lines, told)
}

fn ended(run: Child, mut lines: BufReader<std::process::ChildStderr>) -> (Output, String) {
    let mut told = String::new();
    lines.read_to_string(&mut told).unwrap();
    (run.wait_with_output().unwrap(), told)
}

#[test]
fn it_is_listed_and_taken_first() {
    let Some((machine, _alone)) = machine("listed") else { return };
    let listed = hapflow(&machine, &["devices", "--json"]).output().unwrap();
    let listed: serde_json::Value = serde_json::from_slice(&listed.stdout).unwrap();
    let falcon = listed.as_array().unwrap().iter().find(|device| device["name"] == "falcon").unwrap();
    assert_eq!(falcon["present"], true);
    assert!(falcon["found"].as_str().unwrap().contains(SERIAL), "{falcon}");
    let info = hapflow(&machine, &["falcon", "info"]).output().unwrap();
    let info = String::from_utf8(info.stdout).unwrap();
    assert_eq!(info, format!("bus 1, address 2: serial number {SERIAL}\nits firmware runs\n"));
    let folder = folder("first");
    let (run, lines, told) = homed(&machine, &folder, "1");
    assert!(told.starts_with("device: falcon, a Novint Falcon by USB\n"), "{told}");
    let (output, told) = ended(run, lines);
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && table.contains("mean force"), "{table}\n{told}");
    assert_eq!(machine.side.falcon.lock().unwrap().commanded().0.motors, [0; 3]);
}

#[test]
fn a_cable_that_is_pulled_ends_a_run_with_its_results() {
    let Some((machine, _alone)) = machine("pulled") else { return };
    let folder = folder("pulled");
    let (mut run, lines, told) = homed(&machine, &folder, "600");
    assert!(told.ends_with("homed\n"), "{told}");
    let gives_force = || machine.side.falcon.lock().unwrap().commanded().0.motors != [0; 3];
    while !gives_force() && run.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    machine.unplug().unwrap();
    let (output, told) = ended(run, lines);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(
        told.ends_with("hapflow: the Falcon is lost, it was unplugged: check both cables, and start again\n"),
        "{told}"
    );
    let summary = std::fs::read_to_string(folder.join("summary.json")).unwrap();
    assert!(summary.contains("DEVICE_LOST"), "{summary}");
}

#[test]
fn a_second_program_is_told_that_it_is_in_use() {
    let Some((machine, _alone)) = machine("shared") else { return };
    let (mut run, lines, told) = homed(&machine, &folder("shared"), "600");
    assert!(told.ends_with("homed\n"), "{told}");
    let second = hapflow(&machine, &["falcon", "home"]).output().unwrap();
    let told = String::from_utf8(second.stderr).unwrap();
    assert_eq!(second.status.code(), Some(1), "{told}");
    assert!(told.starts_with("hapflow: the Falcon is in use: ") && told.lines().count() == 1, "{told}");
    assert!(run.try_wait().unwrap().is_none(), "the first goes on");
    assert!(Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap().success());
    assert!(ended(run, lines).0.status.success());
}
