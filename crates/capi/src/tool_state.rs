//! `hapflow_tool_state`: where the hand is, and when.

use crate::caller::{Out, Record};
use crate::code::Code;
use crate::contract::as_in_header;
use crate::fence::fence;
use glam::{DQuat, DVec3};
use hapflow_haptics::ToolState;

/// Farthest that a tool may be, m, and fastest, m/s: beyond any hand, and within what f32 steps soundly.
pub const FARTHEST: f64 = 1000.0;
/// Fastest that it may turn, rad/s.
const FASTEST_TURN: f64 = 1e5;
/// Latest time, s: a third of a year, in which f64 still tells nanoseconds apart.
const LATEST_S: f64 = 1e7;

/// `hapflow_tool_state`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct ToolStateRecord {
    size: u32,
    pub tool: u32,
    buttons: u32,
    reserved: u32,
    pub time_s: f64,
    pub dt_s: f64,
    position: [f64; 3],
    orientation: [f64; 4],
    velocity: [f64; 3],
    angular_velocity: [f64; 3],
}

as_in_header!(
    ToolStateRecord = hapflow_tool_state {
        size,
        tool,
        buttons,
        reserved,
        time_s,
        dt_s,
        position,
        orientation,
        velocity,
        angular_velocity,
    }
);

// SAFETY: repr(C), 16 bytes and fifteen f64: no padding; every field takes any bits.
unsafe impl Record for ToolStateRecord {
    const SIZE_AT: usize = 0;
    const FIRST_SIZE: usize = 136;
}

impl ToolStateRecord {
    /// What the init function writes: a tool at rest in the origin, at 1 kHz.
    pub const DEFAULT: Self = Self {
        size: size_of::<Self>() as u32,
        tool: 0,
        buttons: 0,
        reserved: 0,
        time_s: 0.0,
        dt_s: 1e-3,
        position: [0.0; 3],
        orientation: [0.0, 0.0, 0.0, 1.0],
        velocity: [0.0; 3],
        angular_velocity: [0.0; 3],
    };

    /// The state as the engine takes it, after `last_s`. Whether there is such a tool is not asked here.
    pub fn checked(&self, last_s: f64) -> Result<ToolState, Code> {
        if self.reserved != 0 {
            return Err(Code::ERROR_UNSUPPORTED);
        }
        self.check_time(last_s)?;
        let state = ToolState {
            position: DVec3::from(self.position),
            orientation: DQuat::from_array(self.orientation),
            velocity: DVec3::from(self.velocity),
            angular_velocity: DVec3::from(self.angular_velocity),
            buttons: self.buttons,
        };
        if !state.is_finite() {
            return Err(Code::ERROR_NOT_FINITE);
        }
        let within = |v: DVec3, limit: f64| v.abs().max_element() <= limit;
        if !within(state.position, FARTHEST)
            || !within(state.velocity, FARTHEST)
            || !within(state.angular_velocity, FASTEST_TURN)
        {
            return Err(Code::ERROR_VALUE);
        }
        check_orientation(state.orientation)?;
        Ok(state)
    }

    /// What a device measured at `time_s`, `dt_s` after the last time. It keeps the tool that it is of.
    pub fn measured(&self, state: &ToolState, time_s: f64, dt_s: f64) -> Self {
        Self {
            buttons: state.buttons,
            time_s,
            dt_s,
            position: state.position.to_array(),
            orientation: state.orientation.to_array(),
            velocity: state.velocity.to_array(),
            angular_velocity: state.angular_velocity.to_array(),
            ..*self
        }
    }

    fn check_time(&self, last_s: f64) -> Result<(), Code> {
        check_time(self.time_s)?;
        check_dt(self.dt_s)?;
        if self.time_s >= last_s { Ok(()) } else { Err(Code::ERROR_TIME) }
    }
}

/// Refuses a time since the last tick that cannot be.
pub fn check_dt(dt_s: f64) -> Result<(), Code> {
    if !dt_s.is_finite() {
        return Err(Code::ERROR_NOT_FINITE);
    }
    if dt_s >= 0.0 { Ok(()) } else { Err(Code::ERROR_TIME) }
}

/// Refuses a time that is none of a session's clock.
pub fn check_time(time_s: f64) -> Result<(), Code> {
    if !time_s.is_finite() {
        return Err(Code::ERROR_NOT_FINITE);
    }
    if (0.0..=LATEST_S).contains(&time_s) { Ok(()) } else { Err(Code::ERROR_TIME) }
}

/// Refuses what is no unit quaternion.
pub fn check_orientation(orientation: DQuat) -> Result<(), Code> {
    // Written so that an overflow of the length is refused, too.
    if (orientation.length() - 1.0).abs() <= 1e-3 { Ok(()) } else { Err(Code::ERROR_ORIENTATION) }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_tool_state_init(state: Out<ToolStateRecord>, size: u32) -> Code {
    fence(|| state.init(&ToolStateRecord::DEFAULT, size).map(|()| Code::OK))
}
