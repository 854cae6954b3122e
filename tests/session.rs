//! A session misused, stalled and stopped: the force is always safe.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{jet, open, word};
use glam::DVec3;
use hapflow::devices::{DeviceError, HapticDevice, NullDevice, Pacing};
use hapflow::engine::{Drive, FluidUnit, Scene, SceneError, ServoUnit, Session, SessionOptions, Value};
use hapflow::haptics::{FaultSet, GatedWrench, ToolState};
use hapflow::realtime::VirtualClock;
use std::sync::Arc;
use std::time::Duration;

/// A session in a steady closed-form jet, with its halves.
struct Steady {
    session: Session,
    servo: ServoUnit,
    fluid: FluidUnit,
    tick: u64,
}

impl Steady {
    fn new() -> Self {
        let scene = jet(&[("run.backend", word("analytic-jet"))]);
        let mut session = open(&scene, 1);
        let (servo, fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
        let mut steady = Self { session, servo, fluid, tick: 0 };
        steady.run(1000, true);
        assert!(steady.servo.newest().sent.force.length() > 0.3);
        steady
    }

    /// Ticks, with a fluid that runs or hangs; the largest change of force in one tick.
    fn run(&mut self, ticks: u64, fluid_runs: bool) -> f64 {
        let mut largest = 0.0_f64;
        for _ in 0..ticks {
            let t = self.tick as f64 * 1e-3;
            if fluid_runs && self.tick.is_multiple_of(10) {
                self.fluid.publish(t);
                self.fluid.compute(t);
            }
            let before = self.servo.newest().sent.force;
            self.servo.tick(&ToolState::default(), t, 1e-3);
            largest = largest.max(self.servo.newest().sent.force.distance(before));
            self.tick += 1;
        }
        largest
    }

    fn force(&self) -> f64 {
        self.servo.newest().sent.force.length()
    }
}

#[test]
fn stale_data_holds_three_frames_then_fades_in_100_ms_and_comes_back_without_a_jump() {
    let mut s = Steady::new();
    let steady = s.force();
    // The newest model came at the last multiple of ten ticks: its age is now 9 ms.
    s.run(20, false);
    assert!((s.force() - steady).abs() < 1e-9, "held for three frames");
    s.run(60, false);
    assert!(s.force() < 0.6 * steady && s.force() > 0.0, "fading: {}", s.force());
    s.run(60, false);
    assert_eq!(s.force(), 0.0);
    assert!(s.servo.newest().faults.contains(FaultSet::STALE));
    let largest = s.run(1000, true);
    assert!((s.force() - steady).abs() < 1e-3 && largest < 1.0 + 1e-9, "{largest}");
    assert!(!s.servo.newest().faults.contains(FaultSet::STALE));
}

#[test]
fn a_fault_is_zero_at_once_and_latched_until_cleared() {
    let mut s = Steady::new();
    s.session.control().emergency_stop();
    s.run(1, true);
    assert_eq!(s.force(), 0.0);
    s.run(100, true);
    assert_eq!(s.force(), 0.0);
    s.session.control().clear_faults();
    s.run(1000, true);
    assert!(s.force() > 0.3);

    let bad = ToolState { velocity: DVec3::new(0.0, f64::NAN, 0.0), ..ToolState::default() };
    let sent = s.servo.tick(&bad, 2.2, 1e-3);
    assert_eq!(sent.force(), DVec3::ZERO);
    s.tick += 1;
    s.run(50, true);
    assert_eq!(s.force(), 0.0);
    assert!(s.servo.newest().faults.contains(FaultSet::NON_FINITE_INPUT));
    s.session.control().clear_faults();
    s.run(1000, true);
    assert!(s.force() > 0.3, "the NaN must not have reached the fluid");
}

#[test]
fn settings_are_checked_and_act_while_it_runs() {
    let mut s = Steady::new();
    let steady = s.force();
    s.session.set("tool.force_scale", &Value::Number(2.0)).unwrap();
    s.run(50, true);
    assert!((s.force() / steady - 2.0).abs() < 1e-6);
    s.session.set("source.tap.speed", &Value::Number(2.5)).unwrap();
    s.run(50, true);
    assert!(s.force() > 2.5 * steady);
    for (path, value) in
        [("fluid.viscosity", Value::Number(f64::NAN)), ("fluid.spacing", Value::Number(-1.0))]
    {
        assert!(matches!(s.session.set(path, &value), Err(SceneError::BadValue { .. })));
    }
    assert!(matches!(s.session.set("run.fluid_hz", &Value::Number(50.0)), Err(SceneError::NotLive(_))));
    let stiff = s.session.set("fluid.sound_speed", &Value::Number(2000.0)).unwrap_err().to_string();
    assert!(stiff.contains("the speed of sound is too high"), "{stiff}");
    assert_eq!(s.session.get("fluid.sound_speed").unwrap(), Value::Number(0.0));
    assert_eq!(s.session.get("fluid.viscosity").unwrap(), Value::Number(0.001));
}

#[test]
fn two_sessions_in_one_process_do_not_know_of_each_other() {
    let scene = jet(&[]);
    let alone = drive(&mut [open(&scene, 2)]);
    let both = drive(&mut [open(&scene, 2), open(&scene, 1)]);
    assert_eq!(both[0], alone[0]);
    assert_eq!(both[1], alone[0]);
}

/// Forces of each session, stepped in turn.
fn drive(sessions: &mut [Session]) -> Vec<Vec<DVec3>> {
    let mut halves: Vec<_> =
        sessions.iter_mut().map(|s| (s.take_servo().unwrap(), s.take_fluid().unwrap(), Vec::new())).collect();
    for k in 1..=20 {
        for (servo, fluid, forces) in &mut halves {
            let t = f64::from(k) * 0.01;
            fluid.publish(t);
            fluid.compute(t);
            servo.tick(&ToolState::default(), t, 1e-3);
            forces.push(servo.newest().raw.force);
        }
    }
    halves.into_iter().map(|h| h.2).collect()
}

fn owned(scene: &Scene, device: Box<dyn HapticDevice>) -> Session {
    let options = SessionOptions {
        servo_drive: Drive::Owned,
        fluid_drive: Drive::Owned,
        threads: 1,
        devices: vec![device],
        ..SessionOptions::hosted()
    };
    Session::open(scene, options).unwrap()
}

#[test]
fn owned_threads_run_and_stop() {
    let scene = jet(&[("run.backend", word("analytic-jet"))]);
    let mut session = owned(&scene, Box::new(NullDevice::new(DVec3::ZERO)));
    while session.report().sent.force.length() < 0.1 {
        std::thread::sleep(Duration::from_millis(5));
    }
    session.request_particles();
    assert!(session.realtime_status().is_some() && session.servo_runs());
    let told = session.servo_pace(0).unwrap();
    assert!(told.runs && session.servo_pace(1).is_none());
    let (ticks, _) = session.close();
    assert!(ticks.count() >= told.ticks.count() && ticks.count() == session.report().tick);
    assert!(ticks.longest_ns as f64 * 1e-9 >= ticks.quantile_s(0.1) - 1e-7);
    assert!(session.fluid_report().frame > 0);
    assert!(!session.servo_runs());
}

#[test]
fn an_owned_fluid_keeps_the_time_of_a_hosts_servo() {
    let scene = jet(&[("run.backend", word("analytic-jet"))]);
    let options = SessionOptions { fluid_drive: Drive::Owned, threads: 1, ..SessionOptions::hosted() };
    let mut session = Session::open(&scene, options).unwrap();
    assert!(session.take_fluid().is_none(), "the session owns it");
    let mut servo = session.take_servo().unwrap();
    // A host that stands still gets no frames.
    std::thread::sleep(Duration::from_millis(30));
    assert_eq!(session.fluid_report().frame, 0);
    let mut tick = 0_u64;
    while servo.newest().sent.force.length() < 0.3 {
        servo.tick(&ToolState::default(), tick as f64 * 1e-3, 1e-3);
        tick += 1;
        std::thread::sleep(Duration::from_micros(300));
        assert!(tick < 100_000, "the fluid never came");
    }
    let frames = session.fluid_report().frame;
    assert!(frames >= 1 && frames <= tick / 10 + 1, "{frames} frames in {tick} ticks");
    session.close();
}

/// A device that fails as told.
struct Failing {
    reads: u32,
    panics: bool,
}

impl HapticDevice for Failing {
    fn name(&self) -> &str {
        "failing"
    }
    fn pacing(&self) -> Pacing {
        Pacing::Timer
    }
    fn read(&mut self, _: f64) -> Result<ToolState, DeviceError> {
        self.reads += 1;
        assert!(self.reads < 30 || !self.panics, "a driver's bug");
        if self.reads < 30 {
            Ok(ToolState::default())
        } else {
            Err(DeviceError::Closed { device: "failing" })
        }
    }
    fn write(&mut self, _: GatedWrench, _: f64) -> Result<(), DeviceError> {
        Ok(())
    }
    fn close(&mut self) {}
}

#[test]
fn a_lost_device_or_a_panic_ends_the_servo_with_a_fault() {
    let scene = jet(&[("run.backend", word("analytic-jet"))]);
    for (panics, fault) in [(false, FaultSet::DEVICE_LOST), (true, FaultSet::PANIC)] {
        let mut session = owned(&scene, Box::new(Failing { reads: 0, panics }));
        while session.servo_runs() {
            std::thread::sleep(Duration::from_millis(2));
        }
        assert!(session.control().faults().contains(fault));
        session.close();
    }
}

#[test]
fn an_owned_servo_needs_a_device() {
    let options = SessionOptions { servo_drive: Drive::Owned, ..SessionOptions::hosted() };
    assert!(Session::open(&jet(&[]), options).is_err());
}

/// A device that takes 1.7 ms for each state.
struct Slow {
    clock: Arc<VirtualClock>,
    reads: u32,
}

impl HapticDevice for Slow {
    fn name(&self) -> &str {
        "slow"
    }
    fn pacing(&self) -> Pacing {
        Pacing::Device
    }
    fn read(&mut self, _: f64) -> Result<ToolState, DeviceError> {
        self.clock.advance_ns(1_700_000);
        self.reads += 1;
        if self.reads <= 50 { Ok(ToolState::default()) } else { Err(DeviceError::Closed { device: "slow" }) }
    }
    fn write(&mut self, _: GatedWrench, _: f64) -> Result<(), DeviceError> {
        Ok(())
    }
    fn close(&mut self) {}
}

/// No timer runs beside it, and the ticks have the times at which its states came.
#[test]
fn a_device_that_paces_sets_the_ticks() {
    let clock = Arc::new(VirtualClock::new());
    let options = SessionOptions {
        servo_drive: Drive::Owned,
        devices: vec![Box::new(Slow { clock: Arc::clone(&clock), reads: 0 })],
        clock,
        tape: 64,
        ..SessionOptions::hosted()
    };
    let mut session = Session::open(&jet(&[("run.backend", word("analytic-jet"))]), options).unwrap();
    let mut tape = session.take_tape(0).unwrap();
    while session.servo_runs() {
        std::thread::sleep(Duration::from_millis(2));
    }
    let times: Vec<_> = std::iter::from_fn(|| tape.pop()).map(|report| report.time_s).collect();
    assert_eq!(times.len(), 50);
    for (n, time) in times.into_iter().enumerate() {
        assert!((time - 1.7e-3 * (n + 1) as f64).abs() < 1e-9, "tick {n} at {time}");
    }
    session.close();
    assert_eq!(session.take_lost(), Some(DeviceError::Closed { device: "slow" }));
}

/// While its button is down the hand is free, and the tool stays; then both go on from there.
#[test]
fn a_clutch_frees_the_hand() {
    let scene = jet(&[("run.backend", word("analytic-jet")), ("mapping.clutch_button", Value::Number(2.0))]);
    let mut session = open(&scene, 1);
    let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
    let mut tick = |n: u32, x: f64, buttons: u32| {
        let time_s = f64::from(n) * 1e-3;
        if n.is_multiple_of(10) {
            fluid.publish(time_s);
            fluid.compute(time_s);
        }
        servo.tick(&ToolState { buttons, ..ToolState::at(DVec3::X * x) }, time_s, 1e-3);
        (servo.newest().tool.position.x, servo.newest().sent.force.length())
    };
    let (_, felt) = (0..1000).map(|n| tick(n, 0.0, 1)).last().unwrap();
    assert!(felt > 0.3, "{felt}");
    let (place, felt) = (1000..1100).map(|n| tick(n, f64::from(n - 1000) * 1e-4, 2)).last().unwrap();
    assert!(place == 0.0 && felt < 1e-9, "at {place} with {felt} N");
    let (place, felt) = (1100..1300).map(|n| tick(n, 0.0099, 0)).last().unwrap();
    assert!(place.abs() < 1e-12 && felt > 0.3, "at {place} with {felt} N");
}
