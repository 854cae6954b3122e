//! The [obstacle] functions: where the host has the obstacles. No lock, no allocation, no log, no system call.

use crate::caller::{In, Out};
use crate::code::{Code, Outcome};
use crate::fence::fence;
use crate::handle::Handle;
use crate::hooks;
use crate::session::with_any;
use crate::table::LIBRARY;
use crate::tool_state::{FARTHEST, check_orientation};
use glam::{DQuat, DVec3};
use hapflow_engine::{Control, ObstacleMover};
use hapflow_haptics::FaultSet;
use hapflow_realtime::Faultable;

/// The obstacles' part of a session.
pub struct ObstacleSide {
    /// Not in its lane itself, as little as a tool: see [`crate::servo::ServoSide`].
    mover: Box<ObstacleMover>,
    control: Control,
}

impl Faultable for ObstacleSide {
    fn fault(&mut self) {
        self.control.raise(FaultSet::PANIC);
    }
}

impl ObstacleSide {
    pub fn new(mover: ObstacleMover, control: Control) -> Self {
        Self { mover: Box::new(mover), control }
    }

    /// How many there are.
    pub fn count(&self) -> u32 {
        self.mover.count() as u32
    }

    fn set(&mut self, index: u32, position: DVec3, orientation: DQuat) -> Outcome {
        if index >= self.count() {
            return Err(Code::ERROR_INDEX);
        }
        if !position.is_finite() || !orientation.is_finite() {
            return Err(Code::ERROR_NOT_FINITE);
        }
        if position.abs().max_element() > FARTHEST {
            return Err(Code::ERROR_VALUE);
        }
        check_orientation(orientation)?;
        if self.mover.set(index as usize, position, orientation) {
            Ok(Code::OK)
        } else {
            Err(Code::ERROR_VALUE)
        }
    }
}

fn with_obstacles(session: Handle, body: impl FnOnce(&mut ObstacleSide) -> Outcome) -> Code {
    fence(|| {
        let mut side = LIBRARY.obstacles(session)?;
        hooks::panic_if_asked();
        body(&mut side)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_obstacle_count(session: Handle, count: Out<u32>) -> Code {
    with_any(session, |side| {
        count.put(side.obstacles())?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_obstacle_move(
    session: Handle,
    index: u32,
    position: In<[f64; 3]>,
    orientation: In<[f64; 4]>,
) -> Code {
    with_obstacles(session, |side| {
        let (position, orientation) = (position.whole()?, orientation.whole()?);
        side.set(index, DVec3::from(position), DQuat::from_array(orientation))
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_obstacle_publish(session: Handle) -> Code {
    with_obstacles(session, |side| {
        side.mover.publish();
        Ok(Code::OK)
    })
}
