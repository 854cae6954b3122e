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
use std::process::{Child, Command, Stdio};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use usb::{Machine, SERIAL, Side};

/// Set for the inner run.
const INNER: &str = "HAPFLOW_INNER_TEST";

/// Whether this is the inner run, which then goes on; the outer one serves a device with `trouble` meanwhile.
///
/// The driver's deadlines are real ones: a machine that is too busy to play the device in time is given two more chances.
fn inner(name: &str, trouble: Trouble, firmware_runs: bool, set: impl Fn(&Machine)) -> bool {
    if std::env::var_os(INNER).is_some() {
        return true;
    }
    if !has_umockdev() {
        return false;
    }
    let _alone = alone();
    for chance in 0..3 {
        let machine = Machine::new(name, emulated(trouble.clone(), firmware_runs)).unwrap();
        set(&machine);
        let told = end(start(name, &machine), &machine);
        match told {
            Ok(()) => break,
            Err(told) => assert!(chance < 2 && told.contains("Lost { cause: TimedOut }"), "{told}"),
        }
    }
    false
}

/// One at a time: the driver's deadlines are real ones, and a machine may have few cores.
fn alone() -> MutexGuard<'static, ()> {
    static ONE: Mutex<()> = Mutex::new(());
    ONE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn has_umockdev() -> bool {
    let probe = Command::new("true").env("LD_PRELOAD", "libumockdev-preload.so.0").output().unwrap();
    if !probe.stderr.is_empty() {
        println!("SKIPPED: no umockdev (apt-get install umockdev)");
    }
    probe.stderr.is_empty()
}

fn emulated(trouble: Trouble, firmware_runs: bool) -> EmulatedFalcon {
    let kinematics = Kinematics::new(Geometry::load("libnifalcon").unwrap());
    let stir =
        Segment::Sine { amplitude: DVec3::new(0.02, 0.01, 0.0), frequency_hz: 0.5, duration_s: 1000.0 };
    EmulatedFalcon::new(EmulatedHand::new(kinematics, &[stir], true).unwrap(), trouble, firmware_runs)
}

/// Starts the inner run.
fn start(name: &str, machine: &Machine) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--nocapture", "--test-threads=1"])
        .envs(machine.environment())
        .env(INNER, "1")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Waits for the inner run, and says what was wrong if it did not go well. It must leave the device without force.
fn end(child: Child, machine: &Machine) -> Result<(), String> {
    let output = child.wait_with_output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    told.lines().filter(|line| line.contains("exchanges in")).for_each(|line| println!("{line}"));
    // Whatever happened: it ends without force, but where nothing reaches the motors any more.
    let cut_off = machine.side.deaf.load(Ordering::Acquire);
    let mut falcon = machine.side.falcon.lock().unwrap();
    let unplugged = falcon.trouble().unplugged_ns.is_some();
    assert!(unplugged || cut_off || falcon.commanded().0.motors == [0; 3]);
    let failed = || format!("{told}\n{}", String::from_utf8_lossy(&output.stderr));
    if output.status.success() { Ok(()) } else { Err(failed()) }
}

fn options() -> FalconOptions {
    FalconOptions { firmware: Some(firmware()), ..FalconOptions::new(Geometry::load("libnifalcon").unwrap()) }
}

fn falcon() -> Falcon {
    Falcon::new(open(None).unwrap(), options()).unwrap()
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
        let held = open(None).unwrap();
        assert_eq!(open(None).err(), Some(FalconError::Busy));
        drop(held);
        open(None).unwrap().close();
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
        assert!(after.replies - before.replies >= 10_000);
        assert_eq!(after.line_errors, 0);
        // On a busy machine the arms, which live four times as fast, seem to jump.
        assert!(after.unsound < 100, "{after:?}");
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

/// Refused commands are sent again, and packets of anything are passed over.
#[test]
fn refused_commands_and_noise_are_got_over() {
    let spoil = |machine: &Machine| {
        machine.side.refuses_every.store(37, Ordering::Release);
        machine.side.noise_every.store(23, Ordering::Release);
    };
    if inner("refused_commands_and_noise_are_got_over", Trouble::default(), true, spoil) {
        let mut falcon = ready();
        for _ in 0..2_000 {
            tick(&mut falcon).unwrap();
        }
        let stats = falcon.stats();
        assert!(stats.resent > 50 && stats.dropped_bytes > 500 && stats.line_errors > 10, "{stats:?}");
    }
}

#[test]
fn a_device_that_only_makes_noise_is_lost() {
    if inner("a_device_that_only_makes_noise_is_lost", Trouble::default(), true, |machine| {
        let side = Arc::clone(&machine.side);
        std::thread::spawn(move || {
            wait(&side, |falcon| falcon.commanded().0.motors != [0; 3]);
            side.noise_every.store(1, Ordering::Release);
        });
    }) {
        let mut falcon = ready();
        let gone = (0..100_000).find_map(|_| tick(&mut falcon).err());
        assert_eq!(gone, Some(FalconError::Lost { cause: LinkError::TimedOut }.into()));
        assert_eq!(falcon.read(0.0), Err(FalconError::NotReady.into()));
    }
}

/// Nothing that is sent to it is taken any more: transfers never end by themselves.
#[test]
fn a_device_that_hangs_is_lost() {
    if inner("a_device_that_hangs_is_lost", Trouble::default(), true, |machine| {
        let side = Arc::clone(&machine.side);
        std::thread::spawn(move || {
            wait(&side, |falcon| falcon.commanded().0.motors != [0; 3]);
            side.deaf.store(true, Ordering::Release);
        });
    }) {
        let mut falcon = ready();
        let gone = (0..100_000).find_map(|_| tick(&mut falcon).err());
        assert_eq!(gone, Some(FalconError::Lost { cause: LinkError::TimedOut }.into()));
        assert_eq!(falcon.read(0.0), Err(FalconError::NotReady.into()));
        drop(falcon);
        // It hangs still: vendor requests do not end either.
        let gone = self::falcon().start(&mut |_| {});
        assert_eq!(gone, Err(FalconError::Lost { cause: LinkError::TimedOut }));
    }
}

/// Waits until the device is in a state.
fn wait(side: &Side, reached: impl Fn(&EmulatedFalcon) -> bool) {
    while !reached(&side.falcon.lock().unwrap()) {
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Pulled while its firmware is loaded, while it is homed and while it gives force, and plugged in again each time, where it begins
/// without firmware and unhomed.
#[test]
fn it_may_be_unplugged_at_any_stage_and_plugged_in_again() {
    let name = "it_may_be_unplugged_at_any_stage_and_plugged_in_again";
    if std::env::var_os(INNER).is_some() {
        return goes_on_after_every_loss();
    }
    if !has_umockdev() {
        return;
    }
    let stages: [fn(&EmulatedFalcon) -> bool; 3] = [
        |falcon| falcon.loaded_bytes() > 300 || falcon.firmware_runs(),
        |falcon| falcon.firmware_runs() && falcon.commanded().0.homing,
        |falcon| falcon.commanded().0.motors != [0; 3],
    ];
    let _alone = alone();
    let mut machine = Machine::new(name, emulated(Trouble::default(), false)).unwrap();
    let mut run = start(name, &machine);
    for stage in stages {
        let mut until = |reached: &dyn Fn(&Side) -> bool| {
            while !reached(&machine.side) && run.try_wait().unwrap().is_none() {
                std::thread::sleep(Duration::from_millis(1));
            }
        };
        until(&|side| stage(&side.falcon.lock().unwrap()));
        machine.unplug().unwrap();
        until(&|side| side.clients.load(Ordering::Acquire) == 0);
        machine.plug(emulated(Trouble::default(), false)).unwrap();
    }
    end(run, &machine).unwrap();
    assert!(machine.side.falcon.lock().unwrap().firmware_runs());
}

fn goes_on_after_every_loss() {
    let mut losses = 0;
    while losses < 3 {
        let Ok(transport) = open(None) else {
            std::thread::sleep(Duration::from_millis(5));
            continue;
        };
        let mut falcon = Falcon::new(transport, options()).unwrap();
        let begun = falcon.prepare(&mut |_| ControlFlow::Continue(()));
        let lost = begun.err().or_else(|| (0..100_000).find_map(|_| tick(&mut falcon).err()));
        assert_eq!(falcon.read(0.0), Err(FalconError::NotReady.into()));
        match lost {
            Some(DeviceError::Falcon(FalconError::Lost { cause: LinkError::Unplugged })) => losses += 1,
            // A machine that is too busy to play the device.
            Some(DeviceError::Falcon(FalconError::Lost { cause: LinkError::TimedOut })) => {}
            other => panic!("{other:?}"),
        }
    }
    let mut falcon = loop {
        match open(None) {
            Ok(transport) => break Falcon::new(transport, options()).unwrap(),
            Err(_) => std::thread::sleep(Duration::from_millis(5)),
        }
    };
    falcon.prepare(&mut |_| ControlFlow::Continue(())).unwrap();
    for _ in 0..500 {
        tick(&mut falcon).unwrap();
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
