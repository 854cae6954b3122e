//! The [servo] function: one tick of one tool. No lock, no allocation, no log, no system call.

use crate::caller::{In, Out};
use crate::code::{Code, Outcome};
use crate::fence::fence;
use crate::hooks;
use crate::lane::{Alone, Faultable};
use crate::session::Alarm;
use crate::table::{Handle, LIBRARY};
use crate::tool_state::ToolStateIn;
use crate::wrench::WrenchOut;
use hapflow_engine::{ServoReport, ServoUnit};
use hapflow_haptics::{FaultSet, MAX_TICK_S};

/// One tool's part of a session.
pub struct ServoSide {
    /// Not in its lane itself: the library's static has lanes for all tools of all sessions.
    unit: Box<ServoUnit>,
    alarm: Alarm,
    last_s: f64,
}

impl Faultable for ServoSide {
    fn fault(&mut self) {
        self.alarm.raise(FaultSet::PANIC);
    }
}

impl ServoSide {
    pub fn new(unit: ServoUnit, alarm: Alarm) -> Self {
        Self { unit: Box::new(unit), alarm, last_s: 0.0 }
    }

    fn tick(&mut self, state: &ToolStateIn) -> Result<(Code, WrenchOut), Code> {
        let (time_s, dt_s) = (state.time_s, state.dt_s);
        let tool = state.checked(self.last_s).inspect_err(|_| {
            // The hand gets zero now; were nothing raised, the next sound tick would throw the force back at once.
            self.alarm.raise(FaultSet::NON_FINITE_INPUT);
        })?;
        self.last_s = time_s;
        let raised = self.alarm.raised();
        if !raised.is_empty() {
            self.unit.raise(raised);
        }
        let sent = self.unit.tick(&tool, time_s, dt_s);
        Ok((remark(self.unit.newest(), dt_s), sent.into()))
    }
}

/// The state, and the tool that it is of.
fn enter<'a>(session: Handle, input: In<ToolStateIn>) -> Result<(Alone<'a, ServoSide>, ToolStateIn), Code> {
    let refused = match input.read(ToolStateIn::DEFAULT) {
        Ok(state) => match LIBRARY.servo(session, state.tool) {
            Err(Code::ERROR_INDEX) => Code::ERROR_INDEX,
            entered => return Ok((entered?, state)),
        },
        Err(unreadable) => unreadable,
    };
    LIBRARY.any(session)?.refuse_input();
    Err(refused)
}

fn remark(newest: &ServoReport, dt_s: f64) -> Code {
    if !newest.faults.latching().is_empty() {
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
    state: In<ToolStateIn>,
    wrench: Out<WrenchOut>,
) -> Code {
    fence(|| -> Outcome {
        // First of all, so that whatever happens next leaves no force.
        wrench.put(WrenchOut::ZERO)?;
        let (mut side, state) = enter(session, state)?;
        hooks::panic_if_asked();
        let (code, sent) = side.tick(&state)?;
        wrench.put(sent)?;
        Ok(code)
    })
}
