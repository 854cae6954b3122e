//! `hapflow_body_report`: a body in the fluid, and what the fluid does to it.

use crate::caller::{Out, Record};
use crate::code::{Code, Failure};
use crate::contract::as_in_header;
use crate::fence::fence;
use crate::generated as c;
use crate::handle::Handle;
use crate::session::with_main;
use glam::DVec3;
use hapflow_engine::{BodyList, BodyReport};
use hapflow_fluid::{BodyLoad, BodySample};

/// `hapflow_body_report`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct BodyRecord {
    size: u32,
    reserved: u32,
    position: [f64; 3],
    orientation: [f64; 4],
    velocity: [f64; 3],
    angular_velocity: [f64; 3],
    pressure_force: [f64; 3],
    viscous_force: [f64; 3],
    torque: [f64; 3],
}

as_in_header!(
    BodyRecord = hapflow_body_report {
        size,
        reserved,
        position,
        orientation,
        velocity,
        angular_velocity,
        pressure_force,
        viscous_force,
        torque,
    }
);

// SAFETY: repr(C), two u32 and then 8-byte fields: no padding; every field takes any bits.
unsafe impl Record for BodyRecord {
    const SIZE_AT: usize = 0;
    const FIRST_SIZE: usize = 184;
}

impl From<&BodyReport> for BodyRecord {
    fn from(report: &BodyReport) -> Self {
        let BodyReport { state, load } = report;
        Self {
            size: size_of::<Self>() as u32,
            reserved: 0,
            position: state.position.to_array(),
            orientation: state.orientation.to_array(),
            velocity: state.velocity.to_array(),
            angular_velocity: state.angular_velocity.to_array(),
            pressure_force: load.pressure_force.to_array(),
            viscous_force: load.viscous_force.to_array(),
            torque: load.torque.to_array(),
        }
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_body_report_init(report: Out<BodyRecord>, size: u32) -> Code {
    let resting = BodyReport { state: BodySample::at(DVec3::ZERO), load: BodyLoad::default() };
    fence(|| report.init(&BodyRecord::from(&resting), size).map(|()| Code::OK))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_body_report(
    session: Handle,
    which: u32,
    index: u32,
    report: Out<BodyRecord>,
) -> Code {
    with_main(session, |side| {
        report.check_record()?;
        let list = match which {
            c::HAPFLOW_BODY_TOOL => (BodyList::Tools, "tool"),
            c::HAPFLOW_BODY_OBSTACLE => (BodyList::Obstacles, "obstacle"),
            c::HAPFLOW_BODY_FREE => (BodyList::Free, "body"),
            other => {
                let text = format!("which = {other}: must be HAPFLOW_BODY_TOOL (1) to HAPFLOW_BODY_FREE (3)");
                return Err(Failure { code: Code::ERROR_UNSUPPORTED, text });
            }
        };
        report.fill(&BodyRecord::from(&side.body(list, index)?))?;
        Ok(Code::OK)
    })
}
