//! `hapflow_report`: the newest tick and the newest fluid frame.

use crate::caller::{Out, Record};
use crate::code::Code;
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use hapflow_engine::{FluidReport, ServoReport};
use hapflow_haptics::FaultSet;

/// `hapflow_report`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Report {
    size: u32,
    faults: u32,
    tick: u64,
    time_s: f64,
    position: [f64; 3],
    body: [f64; 3],
    raw_force: [f64; 3],
    raw_torque: [f64; 3],
    force: [f64; 3],
    torque: [f64; 3],
    model_frame: u64,
    model_age_s: f64,
    fluid_frame: u64,
    fluid_time_s: f64,
    particles: u64,
    substeps: u64,
    max_speed: f64,
    load_force: [f64; 3],
    load_torque: [f64; 3],
    degraded: u64,
}

as_in_header!(
    Report = hapflow_report {
        size,
        faults,
        tick,
        time_s,
        position,
        body,
        raw_force,
        raw_torque,
        force,
        torque,
        model_frame,
        model_age_s,
        fluid_frame,
        fluid_time_s,
        particles,
        substeps,
        max_speed,
        load_force,
        load_torque,
        degraded,
    }
);

// SAFETY: repr(C), two u32 and then 8-byte fields: no padding; every field takes any bits.
unsafe impl Record for Report {
    const SIZE_AT: usize = 0;
    const FIRST_SIZE: usize = 280;
}

impl Report {
    /// Before any tick.
    fn empty() -> Self {
        Self::of(&ServoReport::default(), &FluidReport::default(), FaultSet::NONE)
    }

    /// What it says of a tick and a frame. `faults` are those that were raised since that tick.
    pub fn of(servo: &ServoReport, fluid: &FluidReport, faults: FaultSet) -> Self {
        Self {
            size: size_of::<Self>() as u32,
            faults: (servo.faults | faults).bits(),
            tick: servo.tick,
            time_s: servo.time_s,
            position: servo.tool.position.to_array(),
            body: servo.body.to_array(),
            raw_force: servo.raw.force.to_array(),
            raw_torque: servo.raw.torque.to_array(),
            force: servo.sent.force.to_array(),
            torque: servo.sent.torque.to_array(),
            model_frame: servo.frame,
            model_age_s: servo.age_s,
            fluid_frame: fluid.frame,
            fluid_time_s: fluid.time_s,
            particles: fluid.particles as u64,
            substeps: fluid.substeps as u64,
            max_speed: fluid.max_speed,
            load_force: fluid.load.force.to_array(),
            load_torque: fluid.load.torque.to_array(),
            degraded: fluid.degraded,
        }
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_report_init(report: Out<Report>, size: u32) -> Code {
    fence(|| report.init(&Report::empty(), size).map(|()| Code::OK))
}

/// The header's faults are the servo's; each in words.
pub const FAULTS: &[(u32, FaultSet, &str)] = &[
    (c::HAPFLOW_FAULT_INPUT, FaultSet::NON_FINITE_INPUT, "a tool state was refused"),
    (c::HAPFLOW_FAULT_FORCE, FaultSet::NON_FINITE_FORCE, "a computed force was not finite"),
    (c::HAPFLOW_FAULT_PANIC, FaultSet::PANIC, "a defect of the library"),
    (c::HAPFLOW_FAULT_STALE, FaultSet::STALE, "the fluid's newest frame is too old: the force fades"),
    (c::HAPFLOW_FAULT_DEVICE_LOST, FaultSet::DEVICE_LOST, "the device no longer answers"),
    (c::HAPFLOW_FAULT_EMERGENCY_STOP, FaultSet::EMERGENCY_STOP, "emergency stop"),
    (
        c::HAPFLOW_FAULT_PATH_OVERFLOW,
        FaultSet::PATH_OVERFLOW,
        "part of the tool's path never reached the fluid",
    ),
    (c::HAPFLOW_FAULT_FLUID, FaultSet::FLUID_FAULT, "the fluid gave up"),
    (c::HAPFLOW_FAULT_LATE_TICK, FaultSet::LATE_TICK, "the servo ticked late"),
    (c::HAPFLOW_FAULT_FORCE_LIMITED, FaultSet::FORCE_LIMITED, "the wanted force was larger than allowed"),
    (c::HAPFLOW_FAULT_SLEW_LIMITED, FaultSet::SLEW_LIMITED, "the force was to change faster than allowed"),
];

const _: () = {
    let mut n = 0;
    while n < FAULTS.len() {
        assert!(FAULTS[n].0 == FAULTS[n].1.bits());
        n += 1;
    }
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_of_the_header_is_checked_and_stands_in_its_group() {
        let header = include_str!("../../../include/hapflow/report.h");
        assert_eq!(header.matches("    HAPFLOW_FAULT_").count(), FAULTS.len());
        let (latching, _) = header.split_once("/* Remarks, which go by themselves").unwrap();
        let latches = FAULTS.iter().filter(|f| !f.1.latching().is_empty()).count();
        assert_eq!(latching.matches("= 1 <<").count(), latches);
    }
}
