//! A SpaceMouse through the real hidraw code, against a device that umockdev's preload library makes it see.
#![cfg(all(target_os = "linux", feature = "hid"))]
#![allow(clippy::unwrap_used, clippy::panic)]

mod hid;

use glam::DVec3;
use hapflow_devices::hid::SpaceMouse;
use hapflow_devices::{DeviceError, HapticDevice};
use hapflow_haptics::GatedWrench;
use hid::Machine;
use std::process::Command;

/// Set for the inner run.
const INNER: &str = "HAPFLOW_INNER_TEST";

/// Whether this is the inner run, which then goes on; the outer one has a machine with a cap that does as `act` says.
fn inner(name: &str, act: impl FnOnce(&mut Machine)) -> bool {
    if std::env::var_os(INNER).is_some() {
        return true;
    }
    let probe = Command::new("true").env("LD_PRELOAD", "libumockdev-preload.so.0").output().unwrap();
    if !probe.stderr.is_empty() {
        println!("SKIPPED: no umockdev (apt-get install umockdev)");
        return false;
    }
    let mut machine = Machine::new(name).unwrap();
    act(&mut machine);
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--nocapture", "--test-threads=1"])
        .envs(machine.environment())
        .env(INNER, "1")
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{told}\n{}", String::from_utf8_lossy(&output.stderr));
    false
}

#[test]
fn a_deflected_cap_moves_the_tool() {
    // 350 to the right, 175 to the user; button 1 down; nonsense in between.
    let act = |machine: &mut Machine| {
        machine.say(&[1, 0x5E, 0x01, 0xAF, 0x00, 0, 0]);
        machine.say(&[9, 9, 9]);
        machine.say(&[3, 0b10]);
    };
    if inner("a_deflected_cap_moves_the_tool", act) {
        moves();
    }
}

#[test]
fn an_unplugged_cap_is_lost() {
    let act = |machine: &mut Machine| {
        machine.say(&[1, 0x5E, 0x01, 0, 0, 0, 0]);
        machine.unplug();
    };
    if inner("an_unplugged_cap_is_lost", act) {
        let mut device = SpaceMouse::open(DVec3::Y).unwrap();
        let lost = device.read(0.0).unwrap_err().to_string();
        assert_eq!(
            lost,
            "spacemouse does not answer any more, its cable is out: plug it in, and start again"
        );
    }
}

fn moves() {
    let mut device = SpaceMouse::open(DVec3::Y).unwrap();
    let mut state = device.read(0.0).unwrap();
    for n in 1..=100 {
        state = device.read(f64::from(n) * 1e-3).unwrap();
        device.write(GatedWrench::ZERO, 1e-3).unwrap();
    }
    // A tenth of a second at 0.2 and 0.1 m/s.
    assert!(state.position.distance(DVec3::new(0.02, 1.0, 0.01)) < 1e-9, "{}", state.position);
    assert!(state.velocity.distance(DVec3::new(0.2, 0.0, 0.1)) < 1e-9);
    assert_eq!(state.buttons, 2);
    // A cap that has fallen silent counts as let go.
    for n in 101..=2000 {
        state = device.read(f64::from(n) * 1e-3).unwrap();
    }
    assert_eq!(state.velocity, DVec3::ZERO);
    assert!(state.position.x < 0.05, "{}", state.position);
    device.close();
    assert_eq!(device.read(3.0), Err(DeviceError::Closed { device: "spacemouse" }));
}

#[test]
fn none_is_told() {
    if std::env::var_os(INNER).is_none() {
        match SpaceMouse::open(DVec3::ZERO) {
            Err(error) => assert!(error.to_string().starts_with("spacemouse cannot be opened, "), "{error}"),
            Ok(_) => println!("SKIPPED: one is plugged in"),
        }
    }
}
