//! Devices behind their makers' libraries, with stand-ins for these that a C compiler makes.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::gated;
use glam::DVec3;
use hapflow_devices::sdk::{ForceDimension, OpenHaptics};
use hapflow_devices::{DeviceError, HapticDevice};
use libloading::Library;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A stand-in, compiled for one test: each has a device of its own. Nothing without a C compiler.
fn stand_in(source: &str, test: &str) -> Option<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/sdk").join(source);
    let library = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{test}.so"));
    let built = Command::new("cc")
        .args(["-shared", "-fPIC", "-Wall", "-Werror", "-o"])
        .arg(&library)
        .arg(source)
        .status();
    match built {
        Ok(status) => {
            assert!(status.success());
            Some(library)
        }
        Err(_) => {
            println!("SKIPPED: no C compiler");
            None
        }
    }
}

/// The test's side of a stand-in.
struct Behind(Library);

impl Behind {
    fn open(library: &Path) -> Self {
        // SAFETY: a library of this test's own.
        Self(unsafe { Library::new(library) }.unwrap())
    }

    fn set(&self, state: u32, position: DVec3, buttons: u32) {
        // SAFETY: the type is that of the function in both stand-ins.
        let set = unsafe { self.0.get::<extern "C" fn(u32, f64, f64, f64, u32) -> i32>("fake_set") }.unwrap();
        set(state, position.x, position.y, position.z, buttons);
    }

    fn get(&self) -> [f64; 7] {
        let mut all = [0.0; 7];
        // SAFETY: both stand-ins write at most seven numbers.
        unsafe { self.0.get::<extern "C" fn(*mut f64) -> i32>("fake_get").unwrap()(all.as_mut_ptr()) };
        all
    }

    fn force(&self) -> DVec3 {
        DVec3::from_slice(&self.get())
    }

    fn run(&self, ticks: i32) -> i32 {
        // SAFETY: the type is that of the function.
        unsafe { self.0.get::<extern "C" fn(i32) -> i32>("fake_run").unwrap()(ticks) }
    }
}

#[test]
fn a_library_that_is_not_installed_is_told_with_where_to_get_it() {
    let nowhere = Path::new("/nowhere/lib.so");
    let told = ForceDimension::open_with(&[nowhere], DVec3::ZERO).unwrap_err().to_string();
    assert!(
        told.starts_with("force-dimension cannot be opened, its library libdhd is not installed: install"),
        "{told}"
    );
    let told = OpenHaptics::open_with(&[nowhere], DVec3::ZERO).unwrap_err().to_string();
    assert!(
        told.starts_with("touch cannot be opened, its library libHD is not installed: install OpenHaptics"),
        "{told}"
    );
}

/// The wrong file, as a user may name one.
#[test]
fn a_library_without_the_functions_is_refused() {
    let Some(library) = stand_in("fake_hd.c", "wrong") else { return };
    let told = ForceDimension::open_with(&[&library], DVec3::ZERO).unwrap_err().to_string();
    assert!(told.contains("its library has no function dhdGetDeviceCount"), "{told}");
}

#[test]
fn force_dimension_in_its_own_axes() {
    let Some(library) = stand_in("fake_dhd.c", "dhd") else { return };
    let behind = Behind::open(&library);
    let mut device = ForceDimension::open_with(&[&library], DVec3::Y).unwrap();
    // Open, motors on, without force as they came on, with its watchdog at 20 ms.
    assert_eq!(behind.get(), [0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 160.0]);
    // Its x is to the user, y right, z up.
    behind.set(1, DVec3::new(0.03, 0.01, 0.02), 5);
    let state = device.read(0.0).unwrap();
    assert_eq!((state.position, state.buttons), (DVec3::new(0.01, 1.02, 0.03), 5));
    let mut velocity = DVec3::ZERO;
    for n in 1..200 {
        let t = f64::from(n) * 1e-3;
        behind.set(1, DVec3::new(0.03, 0.01 + 0.1 * t, 0.02), 0);
        velocity = device.read(t).unwrap().velocity;
    }
    assert!((velocity - DVec3::X * 0.1).length() < 1e-6, "{velocity}");
    device.write(gated(DVec3::new(1.0, 2.0, 3.0)), 1e-3).unwrap();
    assert!(behind.force().distance(DVec3::new(3.0, 1.0, 2.0)) < 1e-12);
    device.close();
    assert_eq!(behind.get()[..5], [0.0; 5]);
    assert_eq!(device.read(0.3), Err(DeviceError::Closed { device: "force-dimension" }));
}

#[test]
fn force_dimension_unplugged_and_dropped() {
    let Some(library) = stand_in("fake_dhd.c", "dhd-unplugged") else { return };
    let behind = Behind::open(&library);
    behind.set(0, DVec3::ZERO, 0);
    let told = ForceDimension::open_with(&[&library], DVec3::ZERO).unwrap_err().to_string();
    assert!(told.contains("cannot be opened, no device found: check its cable"), "{told}");
    behind.set(1, DVec3::ZERO, 0);
    let mut device = ForceDimension::open_with(&[&library], DVec3::ZERO).unwrap();
    device.write(gated(DVec3::X), 1e-3).unwrap();
    behind.set(0, DVec3::ZERO, 0);
    assert!(matches!(device.read(0.0), Err(DeviceError::Lost { .. })));
    assert!(matches!(device.write(gated(DVec3::X), 1e-3), Err(DeviceError::Lost { .. })));
    behind.set(1, DVec3::ZERO, 0);
    drop(device);
    assert_eq!(behind.get()[..5], [0.0; 5]);
}

#[test]
fn touch_by_the_librarys_scheduler() {
    let Some(library) = stand_in("fake_hd.c", "hd") else { return };
    let behind = Behind::open(&library);
    let mut device = OpenHaptics::open_with(&[&library], DVec3::ZERO).unwrap();
    behind.set(0, DVec3::new(10.0, 20.0, -30.0), 2);
    assert_eq!(behind.run(3), 3);
    assert_eq!(behind.force(), DVec3::ZERO);
    let state = device.read(0.0).unwrap();
    assert!((state.position - DVec3::new(0.01, 0.02, -0.03)).length() < 1e-12);
    assert_eq!(state.buttons, 2);
    device.write(gated(DVec3::new(1.0, -2.0, 0.5)), 1e-3).unwrap();
    behind.run(1);
    assert!(behind.force().distance(DVec3::new(1.0, -2.0, 0.5)) < 1e-12);
    // It is held for 20 ticks, and goes when nobody renews it.
    behind.run(19);
    assert_ne!(behind.force(), DVec3::ZERO);
    behind.run(1);
    assert_eq!(behind.force(), DVec3::ZERO);
    // A scheduler that stands still is a device that is lost.
    device.read(0.1).unwrap();
    assert!(matches!(device.read(0.3), Err(DeviceError::Lost { .. })));
    device.write(gated(DVec3::X), 1e-3).unwrap();
    behind.run(1);
    device.close();
    // No force, not enabled, not running, and no call that the library does not allow.
    assert_eq!(behind.get()[..6], [0.0; 6]);
    assert!(device.write(gated(DVec3::X), 1e-3).is_err());
}

#[test]
fn touch_with_an_error_is_lost_and_gives_no_force() {
    let Some(library) = stand_in("fake_hd.c", "hd-error") else { return };
    let behind = Behind::open(&library);
    behind.set(0x0100, DVec3::ZERO, 0);
    let told = OpenHaptics::open_with(&[&library], DVec3::ZERO).unwrap_err().to_string();
    assert!(told.contains("its library reports error 0x0100: check its cable"), "{told}");
    behind.set(0, DVec3::ZERO, 0);
    let mut device = OpenHaptics::open_with(&[&library], DVec3::ZERO).unwrap();
    device.write(gated(DVec3::X), 1e-3).unwrap();
    behind.run(1);
    behind.set(0x0304, DVec3::ZERO, 0);
    assert_eq!(behind.run(5), 1);
    assert!(matches!(device.read(0.0), Err(DeviceError::Lost { .. })));
    drop(device);
    assert_eq!(behind.get()[..6], [0.0; 6]);
}
