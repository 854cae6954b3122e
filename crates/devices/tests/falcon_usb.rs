//! The Falcon's driver through the real libusb, against a device that umockdev's preload library makes it see.
//!
//! Each test runs itself again under that library; the outer one has the device, the inner one the driver.
#![cfg(all(target_os = "linux", feature = "falcon"))]
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;
mod usb;

use common::{firmware, gated};
use glam::DVec3;
use hapflow_devices::falcon::{
    EmulatedFalcon, EmulatedHand, Falcon, FalconError, FalconOptions, Geometry, Kinematics, LinkError, Stage,
    Trouble, open, plugged_in,
};
use hapflow_devices::{DeviceError, HapticDevice, Segment};
use std::ops::ControlFlow;
use std::process::Command;
use std::sync::atomic::Ordering;
use usb::{Machine, SERIAL};

/// Set for the inner run.
const INNER: &str = "HAPFLOW_INNER_TEST";

/// Whether this is the inner run, which then goes on; the outer one serves a device with `trouble` meanwhile.
fn inner(name: &str, trouble: Trouble, firmware_runs: bool, set: impl FnOnce(&Machine)) -> bool {
    if std::env::var_os(INNER).is_some() {
        return true;
    }
    let probe = Command::new("true").env("LD_PRELOAD", "libumockdev-preload.so.0").output().unwrap();
    if !probe.stderr.is_empty() {
        println!("SKIPPED: no umockdev (apt-get install umockdev)");
        return false;
    }
    let kinematics = Kinematics::new(Geometry::load("libnifalcon").unwrap());
    let stir =
        Segment::Sine { amplitude: DVec3::new(0.02, 0.01, 0.0), frequency_hz: 0.5, duration_s: 1000.0 };
    let hand = EmulatedHand::new(kinematics, &[stir], true).unwrap();
    let machine = Machine::new(name, EmulatedFalcon::new(hand, trouble, firmware_runs)).unwrap();
    set(&machine);
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--nocapture", "--test-threads=1"])
        .envs(machine.environment())
        .env(INNER, "1")
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    told.lines().filter(|line| line.contains("exchanges in")).for_each(|line| println!("{line}"));
    assert!(output.status.success(), "{told}\n{}", String::from_utf8_lossy(&output.stderr));
    // Whatever happened: it ends without force, but where nothing reaches the motors any more.
    let mut falcon = machine.side.falcon.lock().unwrap();
    let unplugged = falcon.trouble().unplugged_ns.is_some();
    assert!(unplugged || falcon.commanded().0.motors == [0; 3]);
    false
}

fn falcon() -> Falcon {
    let options = FalconOptions {
        firmware: Some(firmware()),
        ..FalconOptions::new(Geometry::load("libnifalcon").unwrap())
    };
    Falcon::new(open(None).unwrap(), options).unwrap()
}

fn ready() -> Falcon {
    let mut falcon = falcon();
    falcon.prepare(&mut |_| ControlFlow::Continue(())).unwrap();
    falcon
}

fn tick(falcon: &mut Falcon) -> Result<(), DeviceError> {
    falcon.read(0.0)?;
    falcon.write(gated(DVec3::new(0.0, 1.0, -0.5)), 1e-3)
}

#[test]
fn it_is_found_by_its_serial_number() {
    if inner("it_is_found_by_its_serial_number", Trouble::default(), true, |_| {}) {
        let found = plugged_in().unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].bus, found[0].address, &found[0].serial), (1, 2, &Ok(SERIAL.to_owned())));
        open(Some(SERIAL)).unwrap().close();
        assert_eq!(open(Some("other")).err(), Some(FalconError::NotFound { serial: Some("other".into()) }));
    }
}

#[test]
fn from_power_on_through_ten_thousand_exchanges() {
    if inner("from_power_on_through_ten_thousand_exchanges", Trouble::default(), false, |_| {}) {
        let mut falcon = ready();
        let (begin, before) = (std::time::Instant::now(), falcon.stats());
        for _ in 0..10_000 {
            tick(&mut falcon).unwrap();
        }
        let (after, taken) = (falcon.stats(), begin.elapsed());
        assert_eq!(after.replies - before.replies, 10_000);
        assert_eq!((after.unsound, after.line_errors), (0, 0));
        println!("10000 exchanges in {taken:?}, {} sent again", after.resent);
    }
}

#[test]
fn spoilt_and_lost_bytes_and_stalls_are_got_over() {
    let trouble = Trouble { loses_byte_every: 53, garbles_every: 71, ..Trouble::default() };
    let stall = |machine: &Machine| machine.side.stalls_every.store(40, Ordering::Release);
    if inner("spoilt_and_lost_bytes_and_stalls_are_got_over", trouble, true, stall) {
        let mut falcon = ready();
        for _ in 0..2_000 {
            tick(&mut falcon).unwrap();
        }
        let stats = falcon.stats();
        assert!(stats.resent > 50 && stats.dropped_bytes > 500, "{stats:?}");
    }
}

#[test]
fn silence_is_lost() {
    let trouble = Trouble { silent_after: Some(6_000), ..Trouble::default() };
    if inner("silence_is_lost", trouble, true, |_| {}) {
        let mut falcon = ready();
        let gone = (0..10_000).find_map(|_| tick(&mut falcon).err());
        assert_eq!(gone, Some(FalconError::Lost { cause: LinkError::TimedOut }.into()));
    }
}

#[test]
fn an_unplugged_cable_is_lost() {
    // After 8 s of the device's own time: homed, and some seconds on.
    let unplug = |machine: &Machine| {
        let now = machine.side.now();
        machine.side.falcon.lock().unwrap().trouble().unplugged_ns = Some(now + 8_000_000_000);
    };
    if inner("an_unplugged_cable_is_lost", Trouble::default(), true, unplug) {
        let mut falcon = ready();
        let gone = (0..100_000).find_map(|_| tick(&mut falcon).err());
        assert_eq!(gone, Some(FalconError::Lost { cause: LinkError::Unplugged }.into()));
        falcon.close();
    }
}

#[test]
fn a_firmware_that_is_not_accepted_names_its_stage() {
    let trouble = Trouble { spoilt_loads: 1000, ..Trouble::default() };
    if inner("a_firmware_that_is_not_accepted_names_its_stage", trouble, false, |_| {}) {
        let refused = falcon().start(&mut |_| {});
        assert!(
            matches!(
                refused,
                Err(FalconError::NotAccepted { stage: Stage::Image { echoed: 0, .. }, attempts: 10, .. })
            ),
            "{refused:?}"
        );
    }
}

/// A machine without USB, or with other devices only.
#[test]
fn none_is_told() {
    if std::env::var_os(INNER).is_none() {
        let told = open(None).err().unwrap();
        assert!(matches!(told, FalconError::NoUsb { .. } | FalconError::NotFound { .. }), "{told}");
    }
}
