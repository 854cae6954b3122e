//! A Falcon for tests, and what it is driven with.
#![allow(dead_code)]

use glam::DVec3;
use hapflow_devices::Segment;
use hapflow_devices::falcon::{
    EmulatedFalcon, EmulatedHand, EmulatedTransport, Falcon, FalconOptions, Firmware, Geometry, Kinematics,
    Trouble,
};
use hapflow_haptics::{FaultSet, GateSettings, GatedWrench, ModelAge, SafetyGate, Wrench};
use hapflow_realtime::VirtualClock;
use std::sync::{Arc, Mutex, MutexGuard};

/// A Falcon that is emulated on a virtual clock, and the driver's options.
pub struct Bench {
    pub clock: Arc<VirtualClock>,
    pub device: Arc<Mutex<EmulatedFalcon>>,
    pub options: FalconOptions,
}

impl Bench {
    /// One in a hand that does as `script` says once it is homed.
    pub fn new(script: &[Segment], trouble: Trouble, firmware_runs: bool) -> Self {
        Self::with_supply(script, trouble, firmware_runs, true)
    }

    /// As above; without `powered` its supply is not plugged in.
    pub fn with_supply(script: &[Segment], trouble: Trouble, firmware_runs: bool, powered: bool) -> Self {
        let geometry = Geometry::load("libnifalcon").unwrap();
        let hand = EmulatedHand::new(Kinematics::new(geometry.clone()), script, powered).unwrap();
        Self {
            clock: Arc::default(),
            device: Arc::new(Mutex::new(EmulatedFalcon::new(hand, trouble, firmware_runs))),
            options: FalconOptions { firmware: Some(firmware()), ..FalconOptions::new(geometry) },
        }
    }

    pub fn transport(&self) -> Box<EmulatedTransport> {
        Box::new(EmulatedTransport::new(Arc::clone(&self.device), Arc::clone(&self.clock) as _))
    }

    pub fn falcon(&self) -> Falcon {
        Falcon::new(self.transport(), self.options.clone()).unwrap()
    }

    pub fn device(&self) -> MutexGuard<'_, EmulatedFalcon> {
        self.device.lock().unwrap()
    }

    /// The motors as they were last commanded.
    pub fn motors(&self) -> [i16; 3] {
        self.device().commanded().0.motors
    }
}

/// An image as the real ones are built, of nothing in particular.
pub fn firmware() -> Firmware {
    let mut words: Vec<u16> = vec![0x08AA];
    words.extend([0; 8]);
    words.extend([0x3F, 0x8002]);
    for (count, address) in [(600, 0x3F_8002_u32), (40, 0x93A2)] {
        words.extend([count, (address >> 16) as u16, address as u16]);
        words.extend((0..count).map(|n| n.wrapping_mul(40_503)));
    }
    words.push(0);
    Firmware::check(words.into_iter().flat_map(u16::to_le_bytes).collect()).unwrap()
}

/// A force as a gate lets it out.
pub fn gated(force: DVec3) -> GatedWrench {
    let settings =
        GateSettings { max_force_n: 50.0, ramp_in_s: 0.0, max_slew_n_per_s: 1e6, ..GateSettings::default() };
    let mut gate = SafetyGate::new(settings).unwrap();
    gate.pass(Wrench::from_force(force), &ModelAge::FRESH, FaultSet::NONE, 1.0)
}
