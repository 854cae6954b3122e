//! What one Falcon's zero angles and motor strength are is found, at an emulated one that differs from what the driver was
//! told of it; on a virtual clock.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::Bench;
use glam::DVec3;
use hapflow_devices::falcon::{
    EmulatedFalcon, EmulatedHand, Falcon, FalconError, FalconOptions, Geometry, Kinematics, PlaceReading,
    Request, Trouble, strength, zeros,
};
use hapflow_devices::{DeviceError, HapticDevice};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

/// Zero angles are found to a count of the encoders, 0.036 degrees, and the strength to 1 %.
const ZERO_TOLERANCE_DEG: f64 = 0.037;
const STRENGTH_TOLERANCE: f64 = 0.01;

const MIDDLE: DVec3 = FalconOptions::MIDDLE;

/// A Falcon that is not as the driver believes: arms at other angles, and motors of another strength.
fn bench(zero_deg: [f64; 3], counts_per_nm: f64) -> Bench {
    let mut bench = Bench::new(&[], Trouble::default(), true);
    let truth = Geometry { zero_deg, counts_per_nm, ..bench.options.geometry.clone() };
    let hand = EmulatedHand::new(Kinematics::new(truth), &[], true).unwrap();
    bench.device = Arc::new(Mutex::new(EmulatedFalcon::new(hand, Trouble::default(), true)));
    bench
}

/// Homed, and held in the middle.
fn ready(bench: &Bench) -> Falcon {
    let mut falcon = bench.falcon();
    falcon.prepare(&mut |_| ControlFlow::Continue(())).unwrap();
    for _ in 0..2000 {
        falcon.read(0.0).unwrap();
        falcon.write(hapflow_haptics::GatedWrench::ZERO, 1e-3).unwrap();
    }
    falcon
}

/// A person who does as asked.
fn obliging(bench: &Bench) -> impl FnMut(Request) -> ControlFlow<()> {
    let mut last = None;
    move |request| {
        if last != Some(request) {
            let mut device = bench.device();
            match request {
                Request::LetGo => device.hand().let_go(0.0).unwrap(),
                Request::Hang { load_kg } => device.hand().let_go(load_kg).unwrap(),
                Request::HoldStill | Request::HandOver | Request::TakeHold => {}
            }
            last = Some(request);
        }
        ControlFlow::Continue(())
    }
}

fn calibrated(bench: &Bench, load_kg: f64) -> Geometry {
    let mut falcon = ready(bench);
    let mut person = obliging(bench);
    let counts = falcon.measure_held(&mut person).unwrap();
    let mut geometry = bench.options.geometry.clone();
    geometry.zero_deg = zeros(&geometry, &[PlaceReading { counts, place: MIDDLE }]).unwrap().zero_deg;
    let kinematics = Kinematics::new(geometry.clone());
    let readings = falcon.measure_loads(&kinematics, load_kg, &mut person).unwrap();
    let found = strength(&readings).unwrap();
    println!("{found:?}, zero angles {:?}", geometry.zero_deg);
    assert!((found.grip_kg - 0.12).abs() < 0.005, "{found:?}");
    geometry.counts_per_nm = found.counts_per_nm;
    drop(falcon);
    assert_eq!(bench.motors(), [0; 3]);
    geometry
}

#[test]
fn wrong_zero_angles_and_a_wrong_strength_are_found() {
    for (zero_deg, counts_per_nm) in
        [([38.0, 33.5, 36.2], 9000.0), ([31.5, 35.0, 36.0], 4500.0), ([35.0; 3], 6616.0)]
    {
        for load_kg in [0.1, 0.4] {
            let found = calibrated(&bench(zero_deg, counts_per_nm), load_kg);
            for (found, truth) in found.zero_deg.into_iter().zip(zero_deg) {
                assert!((found - truth).abs() < ZERO_TOLERANCE_DEG, "{found} in place of {truth}");
            }
            let off = found.counts_per_nm / counts_per_nm - 1.0;
            assert!(off.abs() < STRENGTH_TOLERANCE, "{} in place of {counts_per_nm}", found.counts_per_nm);
        }
    }
}

/// With what was found the driver tells the hand's true place, and gives the force that it is asked for.
#[test]
fn a_calibrated_driver_is_right() {
    let mut bench = bench([38.0, 33.5, 36.2], 9000.0);
    let away = |bench: &Bench| {
        let mut falcon = ready(bench);
        let place = falcon.read(0.0).unwrap().position;
        falcon.write(common::gated(DVec3::Y * 2.0), 1.0).unwrap();
        falcon.read(0.0).unwrap();
        let mut device = bench.device();
        (place.distance(device.hand().place() - MIDDLE), device.hand().felt().distance(DVec3::Y * 2.0))
    };
    let (place, force) = away(&bench);
    assert!(place > 2e-3 && force > 0.4, "{place} m, {force} N");
    bench.options.geometry = calibrated(&bench, 0.2);
    let fresh = self::bench([38.0, 33.5, 36.2], 9000.0);
    bench.device = fresh.device;
    let (place, force) = away(&bench);
    assert!(place < 1e-4 && force < 0.02, "{place} m, {force} N");
}

#[test]
fn a_person_may_break_it_off_at_any_time() {
    for at in [
        Request::HoldStill,
        Request::HandOver,
        Request::LetGo,
        Request::Hang { load_kg: 0.2 },
        Request::TakeHold,
    ] {
        let bench = bench([35.0; 3], 6616.0);
        let mut falcon = ready(&bench);
        let mut person = obliging(&bench);
        let mut until = |request| if request == at { ControlFlow::Break(()) } else { person(request) };
        let held = falcon.measure_held(&mut until);
        let kinematics = Kinematics::new(bench.options.geometry.clone());
        let loads = held.and_then(|_| falcon.measure_loads(&kinematics, 0.2, &mut until));
        assert_eq!(loads, Err(FalconError::Stopped.into()), "{at:?}");
        drop(falcon);
        assert_eq!(bench.motors(), [0; 3]);
    }
}

/// A grip that is torn away is let go, and a load beyond the range is not tried.
#[test]
fn what_goes_wrong_takes_the_force_off() {
    let bench = bench([35.0; 3], 6616.0);
    let mut falcon = ready(&bench);
    let kinematics = Kinematics::new(bench.options.geometry.clone());
    for load_kg in [0.0, 0.6, f64::NAN] {
        let refused = falcon.measure_loads(&kinematics, load_kg, &mut |_| ControlFlow::Continue(()));
        assert!(matches!(refused, Err(DeviceError::Setting(_))), "{load_kg}: {refused:?}");
    }
    let torn = falcon.measure_loads(&kinematics, 0.2, &mut |request| {
        if let Request::LetGo = request {
            // Far more than the motors carry.
            bench.device().hand().let_go(2.0).unwrap();
        }
        ControlFlow::Continue(())
    });
    assert_eq!(torn, Err(FalconError::GotAway.into()));
    falcon.read(0.0).unwrap();
    assert_eq!(bench.motors(), [0; 3]);
}
