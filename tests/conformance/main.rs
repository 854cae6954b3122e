//! What every device keeps: its numbers are true, its units are ours, and no force is there that nobody asked for.
//!
//! Every device that this build knows is taken through one list. What does not apply to one is said where the list meets it:
//! a device without motors has no force to look at, and one without a cable cannot be lost. The Falcon is an emulated one, makers'
//! libraries are stand-ins, and the SpaceMouse's reports come from the test; the same drivers meet the real libusb and hidraw in
//! `crates/devices/tests`.
#![allow(clippy::unwrap_used, clippy::panic)]

mod subject;

use glam::DVec3;
use hapflow::devices::{self, DeviceError, HapticDevice};
use hapflow::haptics::{FaultSet, GateSettings, GatedWrench, ModelAge, SafetyGate, ToolState, Wrench};
use subject::{Subject, all};

/// A gate as a session has it, but without its ramp.
fn gate() -> SafetyGate {
    SafetyGate::new(GateSettings { ramp_in_s: 0.0, ..GateSettings::default() }).unwrap()
}

/// A device on its way through the list.
struct Tried {
    subject: Subject,
    device: Option<Box<dyn HapticDevice>>,
    time_s: f64,
}

impl Tried {
    fn new(mut subject: Subject) -> Self {
        let device = subject.open();
        Self { subject, device: Some(device), time_s: 0.0 }
    }

    fn device(&mut self) -> &mut dyn HapticDevice {
        self.device.as_deref_mut().unwrap()
    }

    fn read(&mut self) -> Result<ToolState, DeviceError> {
        self.time_s += 1e-3;
        let time_s = self.time_s;
        self.device().read(time_s)
    }

    /// A tick with this wrench.
    fn tick(&mut self, wrench: GatedWrench) -> Result<ToolState, DeviceError> {
        let state = self.read()?;
        self.device().write(wrench, 1e-3)?;
        self.subject.step();
        Ok(state)
    }

    /// The force at the motors; none where there are no motors to look at.
    fn felt(&self) -> Option<DVec3> {
        self.subject.felt.as_ref().map(|felt| felt())
    }

    fn assert_no_force(&self, when: &str) {
        let felt = self.felt().unwrap_or_default();
        assert_eq!(felt, DVec3::ZERO, "{}: force {when}", self.subject.name);
    }

    /// Ticks until a force of 2 N stands.
    fn pushed(mut self) -> Self {
        let mut gate = gate();
        for _ in 0..200 {
            let wrench =
                gate.pass(Wrench::from_force(DVec3::Y * 2.0), &ModelAge::FRESH, FaultSet::NONE, 1e-3);
            self.tick(wrench).unwrap();
        }
        assert!(self.felt().is_none_or(|felt| felt.distance(DVec3::Y * 2.0) < 0.03), "{}", self.subject.name);
        self
    }
}

/// No device is left out: `emulated-falcon` is the driver `falcon` at the same emulation.
#[test]
fn every_device_is_on_the_list() {
    let tried: Vec<_> = all().into_iter().map(|subject| subject.name).collect();
    let has_compiler = tried.contains(&"touch");
    for info in devices::list().into_iter().filter(|info| info.name != "emulated-falcon") {
        let needs_compiler = ["force-dimension", "touch"].contains(&info.name);
        assert!(tried.contains(&info.name) || needs_compiler && !has_compiler, "{}", info.name);
    }
}

#[test]
fn it_is_what_its_entry_says() {
    for subject in all() {
        let mut tried = Tried::new(subject);
        let info = devices::find(tried.device().name()).unwrap();
        assert_eq!(info.name, tried.subject.name);
        // A simulated hand gives way to the force, and has no motors that could be looked at.
        assert_eq!(tried.felt().is_some(), info.driven_dof > 0 && info.name != "hand", "{}", info.name);
        assert_eq!(info.driven_dof == 0, info.max_force_n == 0.0, "{}", info.name);
        assert!(info.sensed_dof >= 3, "{}", info.name);
        assert!(info.rate_hz >= if info.driven_dof > 0 { 500.0 } else { 100.0 }, "{}", info.name);
        assert_eq!(tried.subject.failures.is_empty(), !info.hardware, "{}", info.name);
    }
}

/// What is said to be measured is: a cap turns the tool, and the others leave it upright.
#[test]
fn the_degrees_of_freedom_are_those_of_the_entry() {
    for subject in all() {
        let mut tried = Tried::new(subject);
        let info = devices::find(tried.device().name()).unwrap();
        let turned = (0..200).any(|_| {
            let state = tried.tick(GatedWrench::ZERO).unwrap();
            state.angular_velocity != DVec3::ZERO
        });
        assert_eq!(turned, info.sensed_dof == 6, "{}", info.name);
    }
}

#[test]
fn places_are_metres_in_our_axes() {
    for subject in all() {
        let mut tried = Tried::new(subject);
        let mut state = ToolState::default();
        for _ in 0..3000 {
            state = tried.tick(GatedWrench::ZERO).unwrap();
        }
        let off = state.position.distance(tried.subject.place);
        assert!(off < 1e-4, "{}: {} in place of {}", tried.subject.name, state.position, tried.subject.place);
        assert!(state.is_finite() && state.velocity.length() < 0.02, "{}", tried.subject.name);
    }
}

#[test]
fn there_is_no_force_before_one_is_written() {
    for subject in all() {
        let mut tried = Tried::new(subject);
        tried.assert_no_force("as it was opened");
        for _ in 0..20 {
            tried.read().unwrap();
            tried.subject.step();
            tried.assert_no_force("before one was written");
        }
    }
}

#[test]
fn newtons_come_as_they_were_sent_and_no_faster_than_the_gate_lets_them() {
    for subject in all() {
        let mut tried = Tried::new(subject);
        let mut gate = gate();
        let (mut last, mut largest_change) = (DVec3::ZERO, 0.0_f64);
        let wanted = Wrench::from_force(DVec3::new(30.0, -60.0, 20.0));
        let mut sent = GatedWrench::ZERO;
        for _ in 0..300 {
            sent = gate.pass(wanted, &ModelAge::FRESH, FaultSet::NONE, 1e-3);
            tried.tick(sent).unwrap();
            let felt = tried.felt().unwrap_or_default();
            assert!(felt.length() <= 4.0 * 1.005, "{}: {felt}", tried.subject.name);
            largest_change = largest_change.max(felt.distance(last));
            last = felt;
        }
        // 1000 N/s, and half a count of a motor.
        assert!(largest_change < 1.02, "{}: {largest_change} N in a tick", tried.subject.name);
        if let Some(felt) = tried.felt() {
            assert!(felt.distance(sent.force()) < 0.03, "{}: {felt}", tried.subject.name);
        }
        tried.tick(GatedWrench::ZERO).unwrap();
        tried.tick(GatedWrench::ZERO).unwrap();
        tried.assert_no_force("after none was written");
    }
}

#[test]
fn closing_ends_the_force_and_everything_else() {
    for subject in all() {
        let mut tried = Tried::new(subject).pushed();
        tried.device().close();
        tried.device().close();
        tried.assert_no_force("after it was closed");
        assert!(matches!(tried.read(), Err(DeviceError::Closed { .. })), "{}", tried.subject.name);
        assert!(tried.device().write(GatedWrench::ZERO, 1e-3).is_err(), "{}", tried.subject.name);
    }
}

#[test]
fn dropping_ends_the_force() {
    for subject in all() {
        let mut tried = Tried::new(subject).pushed();
        tried.device = None;
        tried.assert_no_force("after it was dropped");
    }
}

/// Nobody writes any more, as when the program hangs.
#[test]
fn silence_ends_the_force() {
    for subject in all() {
        let mut tried = Tried::new(subject).pushed();
        for _ in 0..200 {
            tried.subject.step();
        }
        tried.assert_no_force("after 200 ms of silence");
    }
}

/// The subjects whose `n`th failure there is, pushed, and failing.
fn failing(n: usize) -> impl Iterator<Item = (&'static str, Tried)> {
    all().into_iter().filter(move |subject| n < subject.failures.len()).map(move |subject| {
        let tried = Tried::new(subject).pushed();
        let (what, fail) = &tried.subject.failures[n];
        fail(true);
        (*what, tried)
    })
}

#[test]
fn a_device_that_fails_is_lost_and_stays_without_force() {
    let mut failed = 0;
    for n in 0..4 {
        for (what, mut tried) in failing(n) {
            let name = tried.subject.name;
            let gone = (0..300).find_map(|_| tried.tick(GatedWrench::ZERO).err());
            assert!(
                gone.is_some_and(|error| error.to_string().contains(": ")),
                "{name}, {what}: it says what to do"
            );
            // When all is well again it has no force, and has to be opened anew.
            (tried.subject.failures[n].1)(false);
            for _ in 0..200 {
                tried.subject.step();
            }
            tried.assert_no_force(what);
            drop(tried.device.take());
            tried.assert_no_force("after it was lost");
            failed += 1;
        }
    }
    assert!(failed >= 5, "{failed} failures of the Falcon and the cap");
}
