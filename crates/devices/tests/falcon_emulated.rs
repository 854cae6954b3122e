//! The Falcon's driver against an emulated device, on a virtual clock.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{Bench, gated};
use glam::DVec3;
use hapflow_devices::falcon::{
    EmulatedFalcon, EmulatedHand, Falcon, FalconError, Geometry, Kinematics, LinkError, Stage, Trouble,
};
use hapflow_devices::{DeviceError, HapticDevice, Pacing, Segment};
use hapflow_haptics::GatedWrench;
use hapflow_realtime::Clock;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

const MIDDLE: DVec3 = DVec3::new(0.0, 0.0, 0.125);

/// Back and forth across the workspace.
fn stir() -> Vec<Segment> {
    vec![Segment::Sine { amplitude: DVec3::new(0.03, 0.02, 0.01), frequency_hz: 0.8, duration_s: 100.0 }]
}

fn ready(bench: &Bench) -> Falcon {
    let mut falcon = bench.falcon();
    falcon.prepare(&mut |_| ControlFlow::Continue(())).unwrap();
    falcon
}

/// One tick with this force; where the grip is.
fn tick(falcon: &mut Falcon, force: DVec3) -> Result<DVec3, DeviceError> {
    let state = falcon.read(0.0)?;
    falcon.write(gated(force), 1e-3)?;
    Ok(state.position)
}

fn lost(cause: LinkError) -> DeviceError {
    DeviceError::Falcon(FalconError::Lost { cause })
}

#[test]
fn from_power_on_to_ready() {
    let bench = Bench::new(&stir(), Trouble::default(), false);
    let mut falcon = bench.falcon();
    assert_eq!(falcon.pacing(), Pacing::Device);
    assert_eq!(falcon.read(0.0), Err(FalconError::NotReady.into()));
    assert_eq!(falcon.write(gated(DVec3::X), 1e-3), Err(FalconError::NotReady.into()));
    let mut told = Vec::new();
    let prepared = falcon.prepare(&mut |text| {
        let newest = bench.device().commanded().0;
        assert_eq!(newest.motors, [0; 3], "force before it is homed");
        if told.last().is_none_or(|last| last != text) {
            told.push(text.to_owned());
        }
        ControlFlow::Continue(())
    });
    assert_eq!(prepared, Ok(()));
    assert!(bench.device().firmware_runs());
    let way = "pull the grip all the way out, then push it straight in; marks: top -, right -, left -";
    assert_eq!(told[..2], ["loading firmware, attempt 1 of 10", way]);
    assert!(told[2].contains("found"), "{told:?}");
    assert_eq!(told.last().unwrap(), "homed");
    // Blue once it is ready.
    tick(&mut falcon, DVec3::ZERO).unwrap();
    tick(&mut falcon, DVec3::ZERO).unwrap();
    assert_eq!(bench.device().commanded().0.leds.mask(), 4);
}

#[test]
fn one_that_runs_needs_no_firmware_and_one_that_does_not_asks_for_it() {
    let mut bench = Bench::new(&[], Trouble::default(), true);
    bench.options.firmware = None;
    ready(&bench);
    let mut bench = Bench::new(&[], Trouble::default(), false);
    bench.options.firmware = None;
    let refused = bench.falcon().prepare(&mut |_| ControlFlow::Continue(()));
    assert_eq!(refused, Err(FalconError::NoFirmware.into()));
    // On request it is loaded all the same.
    let mut bench = Bench::new(&[], Trouble::default(), true);
    bench.options.always_load = true;
    let mut told = String::new();
    bench.falcon().start(&mut |text| told.push_str(text)).unwrap();
    assert_eq!(told, "loading firmware, attempt 1 of 10");
}

#[test]
fn a_start_with_hitches_is_tried_again() {
    let attempts = |trouble: Trouble| {
        let bench = Bench::new(&[], trouble, false);
        let mut attempts = 0;
        bench.falcon().start(&mut |_| attempts += 1).map(|()| attempts)
    };
    assert_eq!(attempts(Trouble { leading_zero: true, ..Trouble::default() }), Ok(1));
    assert_eq!(attempts(Trouble { deaf_handshakes: 3, ..Trouble::default() }), Ok(1));
    assert_eq!(attempts(Trouble { deaf_handshakes: 40, ..Trouble::default() }), Ok(3));
    assert_eq!(attempts(Trouble { spoilt_loads: 4, ..Trouble::default() }), Ok(5));
    let refused = |trouble: Trouble| match attempts(trouble) {
        Err(FalconError::NotAccepted { stage, attempts: 10, cause }) => (stage, cause),
        other => panic!("{other:?}"),
    };
    let deaf = refused(Trouble { deaf_handshakes: 1000, ..Trouble::default() });
    assert_eq!(deaf, (Stage::Handshake, "it does not answer"));
    let spoilt = refused(Trouble { spoilt_loads: 1000, ..Trouble::default() });
    assert_eq!(spoilt, (Stage::Image { echoed: 0, of: 1316 }, "the echo is wrong"));
    let stalled = attempts(Trouble { stalls: 1000, ..Trouble::default() });
    assert_eq!(stalled, Err(FalconError::Lost { cause: LinkError::Stalled }));
}

#[test]
fn errors_say_what_to_do() {
    let error = FalconError::NotAccepted {
        stage: Stage::Image { echoed: 62, of: 8492 },
        attempts: 10,
        cause: "the echo is wrong",
    };
    assert!(error.to_string().starts_with(
        "firmware not accepted at stage image (62 of 8492 bytes came back right), in 10 attempts, the echo is wrong: unplug"
    ));
    let permission = FalconError::NoPermission.to_string();
    assert!(permission.contains("/etc/udev/rules.d/") && permission.contains("ATTR{idProduct}==\"cb48\""));
    let absent = FalconError::NotFound { serial: Some("F7".into()) }.to_string();
    assert!(absent.starts_with("no Falcon found with serial number F7: plug in"));
}

/// Without its supply it answers, and its arms stand still.
#[test]
fn without_a_supply_it_never_homes() {
    let bench = Bench::with_supply(&[], Trouble::default(), true, false);
    let refused = bench.falcon().prepare(&mut |_| ControlFlow::Continue(()));
    assert_eq!(refused, Err(FalconError::NeverHomes.into()));
    assert!(FalconError::NeverHomes.to_string().contains("check the 30 V supply"));
}

/// With either shipped set it homes, and with lengths that no Falcon has it says what is wrong.
#[test]
fn it_homes_with_every_set_that_can_be() {
    let told = |geometry: &Geometry| {
        let mut bench = Bench::new(&[], Trouble::default(), true);
        let hand = EmulatedHand::new(Kinematics::new(geometry.clone()), &[], true).unwrap();
        bench.device = Arc::new(Mutex::new(EmulatedFalcon::new(hand, Trouble::default(), true)));
        bench.options.geometry = geometry.clone();
        bench.falcon().prepare(&mut |_| ControlFlow::Continue(())).err()
    };
    for name in Geometry::NAMES {
        assert_eq!(told(&Geometry::load(name).unwrap()), None, "{name}");
    }
    let mut absurd = Geometry::load("martin").unwrap();
    absurd.link_m = 0.001;
    let emulated = EmulatedHand::new(Kinematics::new(absurd), &[], true);
    assert_eq!(emulated.err(), Some(FalconError::NoPose.into()));
    let mut bench = Bench::new(&[], Trouble::default(), true);
    bench.options.geometry.link_m = 0.01;
    let refused = bench.falcon().prepare(&mut |_| ControlFlow::Continue(()));
    assert_eq!(refused, Err(FalconError::NoPose.into()));
}

#[test]
fn a_person_may_stop_it_while_homing() {
    let bench = Bench::new(&[], Trouble::default(), true);
    let refused = bench.falcon().prepare(&mut |_| ControlFlow::Break(()));
    assert_eq!(refused, Err(FalconError::Stopped.into()));
}

#[test]
fn ten_thousand_exchanges_follow_the_hand_and_give_the_force() {
    let bench = Bench::new(&stir(), Trouble::default(), true);
    let mut falcon = ready(&bench);
    let (begin, before) = (bench.clock.now_ns(), falcon.stats());
    let mut farthest = 0.0_f64;
    for n in 0..10_000 {
        let force = DVec3::new((f64::from(n) * 0.01).sin(), 1.0, -0.5);
        let place = tick(&mut falcon, force).unwrap();
        let mut device = bench.device();
        farthest = farthest.max(place.distance(device.hand().place() - MIDDLE));
        let felt = device.hand().felt();
        assert!(felt.distance(force) < 0.05, "{felt} in place of {force}");
    }
    let (stats, taken_s) = (falcon.stats(), (bench.clock.now_ns() - begin) as f64 * 1e-9);
    println!("{:.0} exchanges a second, farthest {:.2} mm", 1e4 / taken_s, 1e3 * farthest);
    assert!(taken_s < 12.0, "{taken_s} s");
    assert!(farthest < 1e-3, "{farthest} m");
    assert_eq!(stats.replies - before.replies, 10_000);
    assert_eq!((stats.resent, stats.unsound, stats.dropped_bytes, stats.line_errors), (0, 0, 0, 0));
}

/// The velocity is that of the hand, whatever the pace.
#[test]
fn velocity_is_the_hands() {
    let bench =
        Bench::new(&stir(), Trouble { late_every: 7, late_ns: 2_000_000, ..Trouble::default() }, true);
    let mut falcon = ready(&bench);
    let (mut off, mut last) = (0.0_f64, None);
    for n in 0..3000 {
        let state = falcon.read(0.0).unwrap();
        falcon.write(GatedWrench::ZERO, 1e-3).unwrap();
        let now = (bench.clock.now_ns(), bench.device().hand().place());
        if let Some((time, place)) = last.replace(now).filter(|_| n > 100) {
            let true_velocity = (now.1 - place) / ((now.0 - time) as f64 * 1e-9);
            off = off.max(state.velocity.distance(true_velocity));
        }
    }
    // The swing's peak is 190 mm/s; an encoder's step in a millisecond is 40 mm/s, of which a third comes through.
    assert!(off < 0.04, "{off} m/s");
}

#[test]
fn spoilt_lost_and_late_replies_are_got_over() {
    let trouble = Trouble {
        loses_byte_every: 53,
        garbles_every: 71,
        late_every: 97,
        late_ns: 7_000_000,
        ..Trouble::default()
    };
    let bench = Bench::new(&stir(), trouble, true);
    let mut falcon = ready(&bench);
    let mut farthest = 0.0_f64;
    for _ in 0..10_000 {
        let place = tick(&mut falcon, DVec3::X).unwrap();
        farthest = farthest.max(place.distance(bench.device().hand().place() - MIDDLE));
    }
    let stats = falcon.stats();
    println!("{stats:?}, farthest {:.2} mm", 1e3 * farthest);
    assert!(stats.resent > 300 && stats.dropped_bytes > 1000, "{stats:?}");
    // At 190 mm/s a reply that comes 10 ms late is 2 mm behind.
    assert!(farthest < 3e-3, "{farthest} m");
}

/// A digit that is wrong, and looks right, moves nothing.
#[test]
fn misread_encoders_are_not_believed() {
    let bench = Bench::new(&stir(), Trouble::default(), true);
    let mut falcon = ready(&bench);
    bench.device().trouble().misreads_every = 7;
    let (mut last, mut farthest) = (tick(&mut falcon, DVec3::ZERO).unwrap(), 0.0_f64);
    for _ in 0..3000 {
        let place = tick(&mut falcon, DVec3::X).unwrap();
        farthest = farthest.max(place.distance(last));
        last = place;
    }
    let stats = falcon.stats();
    assert!(stats.unsound > 300, "{stats:?}");
    assert!(farthest < 1e-3, "a jump of {farthest} m");
}

/// It is not the device that was silent.
#[test]
fn a_program_that_was_held_up_finds_the_reply_and_begins_without_force() {
    let bench = Bench::new(&[], Trouble::default(), true);
    let mut falcon = ready(&bench);
    for _ in 0..200 {
        tick(&mut falcon, DVec3::Y * 2.0).unwrap();
    }
    let full = bench.motors()[0].abs();
    for pause_ms in [30, 150, 5000] {
        bench.clock.advance_ns(pause_ms * 1_000_000);
        tick(&mut falcon, DVec3::Y * 2.0).unwrap();
        tick(&mut falcon, DVec3::Y * 2.0).unwrap();
        assert!(bench.motors()[0].abs() < full / 20, "after {pause_ms} ms: {:?}", bench.motors());
        for _ in 0..200 {
            tick(&mut falcon, DVec3::Y * 2.0).unwrap();
        }
        assert!(bench.motors()[0].abs() > full / 2);
    }
    assert_eq!(falcon.stats().resent, 0);
}

/// Whatever happens at whatever moment: no panic, no force before it is homed, and none at the end.
#[test]
fn it_may_be_unplugged_at_any_moment() {
    for n in 0..40 {
        let bench = Bench::new(&stir(), Trouble::default(), false);
        bench.device().trouble().unplugged_ns = Some(n * 211_000_003);
        let mut falcon = bench.falcon();
        let begun = falcon.prepare(&mut |_| {
            assert_eq!(bench.motors(), [0; 3]);
            ControlFlow::Continue(())
        });
        let gone = begun.err().or_else(|| (0..10_000).find_map(|_| tick(&mut falcon, DVec3::Y).err()));
        assert_eq!(gone, Some(lost(LinkError::Unplugged)), "at {} ms", n * 211);
        assert!(falcon.read(0.0).is_err() && falcon.write(gated(DVec3::Y), 1e-3).is_err());
        falcon.close();
    }
}

/// All troubles at once, drawn by a generator with a fixed seed.
#[test]
fn no_mixture_of_troubles_makes_it_panic_or_leaves_force() {
    let mut state = 7_u64;
    let mut draw = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    };
    for n in 0..60 {
        let trouble = Trouble {
            deaf_handshakes: draw(20) as u32,
            leading_zero: draw(2) == 1,
            spoilt_loads: draw(3) as u32,
            loses_byte_every: draw(60),
            garbles_every: draw(60),
            misreads_every: draw(60),
            late_every: draw(60),
            late_ns: draw(120_000_000),
            ..Trouble::default()
        };
        let bench = Bench::new(&stir(), trouble, draw(2) == 1);
        let mut falcon = bench.falcon();
        let begun = falcon.prepare(&mut |_| {
            assert_eq!(bench.motors(), [0; 3]);
            ControlFlow::Continue(())
        });
        let silent = bench.device().commanded().1 + 1000 + draw(1000);
        bench.device().trouble().silent_after = Some(silent);
        let gone = begun.err().or_else(|| (0..10_000).find_map(|_| tick(&mut falcon, DVec3::Y).err()));
        assert!(gone.is_some(), "mixture {n}");
        drop(falcon);
        assert_eq!(bench.motors(), [0; 3], "mixture {n}: {gone:?}");
    }
}

#[test]
fn silence_takes_the_force_away_and_then_the_device() {
    let bench = Bench::new(&[], Trouble::default(), true);
    let mut falcon = ready(&bench);
    for _ in 0..200 {
        tick(&mut falcon, DVec3::Y * 2.0).unwrap();
    }
    assert_ne!(bench.motors(), [0; 3]);
    let now = bench.device().commanded().1;
    bench.device().trouble().silent_after = Some(now);
    let begin = bench.clock.now_ns();
    // The reply to the last command is on its way.
    let gone = (0..3).find_map(|_| tick(&mut falcon, DVec3::Y * 2.0).err());
    assert_eq!(gone, Some(lost(LinkError::TimedOut)));
    let taken_ms = (bench.clock.now_ns() - begin) / 1_000_000;
    assert!((100..110).contains(&taken_ms), "{taken_ms} ms");
    // It still heard that there is to be no force.
    assert_eq!(bench.motors(), [0; 3]);
    assert_eq!(falcon.read(0.0), Err(FalconError::NotReady.into()));
}

/// After 30 ms without a reply the force is not there at once.
#[test]
fn after_a_silence_the_force_comes_back_step_by_step() {
    let bench = Bench::new(&[], Trouble::default(), true);
    let mut falcon = ready(&bench);
    for _ in 0..200 {
        tick(&mut falcon, DVec3::Y * 2.0).unwrap();
    }
    let full = bench.motors()[0].abs();
    let n = bench.device().commanded().1;
    // Silent but for the command after some six repetitions.
    *bench.device().trouble() = Trouble { silent_after: Some(n), speaks_every: n + 7, ..Trouble::default() };
    tick(&mut falcon, DVec3::Y * 2.0).unwrap();
    tick(&mut falcon, DVec3::Y * 2.0).unwrap();
    assert!(falcon.stats().resent >= 4, "{:?}", falcon.stats());
    *bench.device().trouble() = Trouble::default();
    let mut last = 0;
    for _ in 0..90 {
        tick(&mut falcon, DVec3::Y * 2.0).unwrap();
        let now = bench.motors()[0].abs();
        assert!(now - last < full / 20, "from {last} to {now} of {full}");
        last = now;
    }
    assert!(last > full / 2);
}

#[test]
fn an_unplugged_cable_is_lost_at_once_and_closing_then_is_quiet() {
    let bench = Bench::new(&[], Trouble::default(), true);
    let mut falcon = ready(&bench);
    tick(&mut falcon, DVec3::Y).unwrap();
    bench.device().trouble().unplugged_ns = Some(bench.clock.now_ns() + 300_000);
    let gone = (0..3).find_map(|_| tick(&mut falcon, DVec3::Y).err());
    assert_eq!(gone, Some(lost(LinkError::Unplugged)));
    falcon.close();
    falcon.close();
    assert_eq!(falcon.read(0.0), Err(DeviceError::Closed { device: "falcon" }));
}

#[test]
fn one_that_forgets_its_marks_gives_no_force() {
    let bench = Bench::new(&[], Trouble::default(), true);
    let mut falcon = ready(&bench);
    for _ in 0..200 {
        tick(&mut falcon, DVec3::Y).unwrap();
    }
    bench.device().hand().unhome();
    let gone = (0..3).find_map(|_| tick(&mut falcon, DVec3::Y).err());
    assert_eq!(gone, Some(FalconError::Unhomed.into()));
    assert_eq!(bench.motors(), [0; 3]);
}

#[test]
fn it_ends_without_force_whatever_happens() {
    let motors = |end: fn(Falcon)| {
        let bench = Bench::new(&[], Trouble::default(), true);
        let mut falcon = ready(&bench);
        for _ in 0..200 {
            tick(&mut falcon, DVec3::Y * 2.0).unwrap();
        }
        assert_ne!(bench.motors(), [0; 3]);
        let _ = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| end(falcon)));
        bench.motors()
    };
    assert_eq!(motors(drop), [0; 3]);
    assert_eq!(motors(|mut falcon| falcon.close()), [0; 3]);
    assert_eq!(motors(|_falcon| panic!("on purpose")), [0; 3]);
}

#[test]
fn buttons_come_through() {
    let bench = Bench::new(&[], Trouble::default(), true);
    let mut falcon = ready(&bench);
    bench.device().hand().press(0b0101);
    let mut buttons = 0;
    for _ in 0..6 {
        buttons = falcon.read(0.0).unwrap().buttons;
        falcon.write(GatedWrench::ZERO, 1e-3).unwrap();
    }
    assert_eq!(buttons, 0b0101);
}
