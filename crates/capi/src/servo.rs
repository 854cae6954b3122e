//! The [servo] function: one tick of one tool. No lock, no allocation, no log, no system call.

use crate::caller::{In, Out};
use crate::code::{Code, Outcome};
use crate::fence::fence;
use crate::handle::Handle;
use crate::hooks;
use crate::table::LIBRARY;
use crate::tool_state::ToolStateRecord;
use crate::wrench::WrenchRecord;
use hapflow_engine::{Control, ServoUnit};
use hapflow_haptics::{FaultSet, MAX_TICK_S};
use hapflow_realtime::{Alone, Faultable};

/// One tool's part of a session.
pub struct ServoSide {
    control: Control,
    last_s: f64,
    /// None: the session's own thread has it. Not in its lane itself: the library's static has lanes for all tools of
    /// all sessions.
    unit: Option<Box<ServoUnit>>,
}

impl Faultable for ServoSide {
    fn fault(&mut self) {
        self.control.raise(FaultSet::PANIC);
    }
}

impl ServoSide {
    pub fn new(unit: Option<ServoUnit>, control: Control) -> Self {
        Self { control, last_s: 0.0, unit: unit.map(Box::new) }
    }

    fn tick(&mut self, state: &ToolStateRecord) -> Result<(Code, WrenchRecord), Code> {
        let unit = self.unit.as_mut().ok_or(Code::ERROR_DRIVE)?;
        let (time_s, dt_s) = (state.time_s, state.dt_s);
        let tool = state.checked(self.last_s).inspect_err(|_| {
            // The hand gets zero now; were nothing raised, the next sound tick would throw the force back at once.
            self.control.raise(FaultSet::NON_FINITE_INPUT);
        })?;
        self.last_s = time_s;
        let sent = unit.tick(&tool, time_s, dt_s);
        Ok((remark(unit.newest().faults, dt_s), sent.into()))
    }
}

/// The state, and the tool that it is of.
fn enter<'a>(
    session: Handle,
    input: In<ToolStateRecord>,
) -> Result<(Alone<'a, ServoSide>, ToolStateRecord), Code> {
    let refused = match input.read(ToolStateRecord::DEFAULT) {
        Ok(state) => match LIBRARY.servo(session, state.tool) {
            Err(Code::ERROR_INDEX) => Code::ERROR_INDEX,
            entered => return Ok((entered?, state)),
        },
        Err(unreadable) => unreadable,
    };
    LIBRARY.any(session)?.refuse_input()?;
    Err(refused)
}

/// What is to be said of a tick with these faults.
pub fn remark(faults: FaultSet, dt_s: f64) -> Code {
    if !faults.latching().is_empty() {
        Code::REMARK_FORCE_HELD
    } else if dt_s == 0.0 {
        Code::REMARK_NO_TIME
    } else if dt_s > MAX_TICK_S {
        Code::REMARK_LATE
    } else {
        Code::OK
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_servo_tick(
    session: Handle,
    state: In<ToolStateRecord>,
    wrench: Out<WrenchRecord>,
) -> Code {
    fence(|| -> Outcome {
        // First of all, so that whatever happens next leaves no force.
        wrench.put(WrenchRecord::ZERO)?;
        let (mut side, state) = enter(session, state)?;
        hooks::panic_if_asked();
        let (code, sent) = side.tick(&state)?;
        wrench.put(sent)?;
        Ok(code)
    })
}
