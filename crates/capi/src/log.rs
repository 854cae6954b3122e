//! What a session has to say: made on main, of what servo and fluid report, and told to a function of the host.

use crate::caller::{LogFunction, LogUser};
use crate::code::{Code, Failure};
use crate::generated as c;
use crate::handle::{Handle, Id};
use crate::report::FAULTS;
use crate::session::with_main;
use hapflow_engine::{Control, Scene, ServoPace, Session};
use hapflow_haptics::FaultSet;
use hapflow_realtime::Grant;
use std::cell::RefCell;

/// Remarks of everyday, which come and go with every splash: told once.
const ONCE: FaultSet = FaultSet::from_bits(FaultSet::FORCE_LIMITED.bits() | FaultSet::SLEW_LIMITED.bits());

/// How much a line matters.
#[derive(Clone, Copy)]
enum Level {
    Error = c::HAPFLOW_LOG_ERROR as isize,
    Warning = c::HAPFLOW_LOG_WARNING as isize,
    Info = c::HAPFLOW_LOG_INFO as isize,
}

/// Lines to be told.
type Lines = Vec<(Level, String)>;

/// The host's function, and what was told to it.
pub struct Log {
    function: LogFunction,
    user: LogUser,
    /// What the scene asks of a device beyond what it bears, until it is told.
    cautions: Vec<String>,
    tools: Vec<ToolTold>,
    /// Frames that the fluid was too slow for, and those that hit a limit.
    skipped: u64,
    degraded: u64,
}

/// What was told of one tool.
#[derive(Clone, Default)]
struct ToolTold {
    faults: FaultSet,
    once: FaultSet,
    /// Whether its owned servo ran when it was last looked at; none before the first time.
    ran: Option<bool>,
}

impl Log {
    /// Of a session of `scene`, if anybody listens.
    pub fn open(function: LogFunction, user: LogUser, scene: &Scene) -> Result<Option<Self>, Failure> {
        let tools = vec![ToolTold::default(); scene.tools().count()];
        let cautions = scene.cautions();
        Ok((!function.is_null()).then_some(Self { function, user, cautions, tools, skipped: 0, degraded: 0 }))
    }

    /// Tells what is new.
    pub fn poll(&mut self, session: &mut Session, control: &Control) {
        let mut lines: Lines = self.cautions.drain(..).map(|text| (Level::Warning, text)).collect();
        let several = self.tools.len() > 1;
        for (n, told) in self.tools.iter_mut().enumerate() {
            let begin = lines.len();
            if let Some(pace) = session.servo_pace(n) {
                told.pace(&pace, &mut lines);
            }
            let newest = session.report_of(n).unwrap_or_default().faults;
            told.faults(newest | control.faults(), &mut lines);
            if several {
                lines[begin..].iter_mut().for_each(|(_, text)| text.insert_str(0, &format!("tool {n}: ")));
            }
        }
        self.fluid(session, &mut lines);
        lines.iter().for_each(|(level, text)| self.function.tell(*level as u32, text, self.user));
    }

    fn fluid(&mut self, session: &mut Session, lines: &mut Lines) {
        let skipped = session.fluid_pace().map_or(0, |pace| pace.skipped);
        counted(&mut self.skipped, skipped, "fluid frames were left out: the fluid is too slow", lines);
        let degraded = session.fluid_report().degraded;
        counted(&mut self.degraded, degraded, "fluid frames hit a limit of the solver", lines);
    }
}

fn counted(told: &mut u64, now: u64, what: &str, lines: &mut Lines) {
    if now > *told {
        lines.push((Level::Warning, format!("{} {what} ({now} so far)", now - *told)));
        *told = now;
    }
}

impl ToolTold {
    fn pace(&mut self, pace: &ServoPace, lines: &mut Lines) {
        if self.ran.is_none() {
            let level = if matches!(pace.priority, Grant::Refused(_)) { Level::Warning } else { Level::Info };
            lines.push((level, format!("real-time priority of the servo: {}", pace.priority)));
        }
        if self.ran != Some(false) && !pace.runs {
            lines.push((Level::Error, "the servo has ended".into()));
        }
        self.ran = Some(pace.runs);
    }

    fn faults(&mut self, now: FaultSet, lines: &mut Lines) {
        let now = now.difference(self.once);
        let (come, gone) = (now.difference(self.faults), self.faults.difference(now));
        self.once |= now.intersection(ONCE);
        self.faults = now.difference(ONCE);
        for (_, fault, words) in FAULTS {
            if come.contains(*fault) && fault.latching().is_empty() {
                lines.push((Level::Warning, format!("remark: {words}")));
            } else if come.contains(*fault) {
                lines.push((Level::Error, format!("fault: {words}; no force until the faults are cleared")));
            } else if gone.contains(*fault) {
                lines.push((Level::Info, format!("no more: {words}")));
            }
        }
    }
}

thread_local! {
    /// Sessions whose log function this thread is in.
    static INSIDE: RefCell<Vec<Id>> = const { RefCell::new(Vec::new()) };
}

/// While it lives, this thread is in the log function of a session.
struct Inside;

impl Inside {
    fn new(session: Handle) -> Self {
        INSIDE.with(|inside| inside.borrow_mut().push(session.id));
        Self
    }
}

impl Drop for Inside {
    fn drop(&mut self) {
        INSIDE.with(|inside| inside.borrow_mut().pop());
    }
}

/// Refuses while this thread is in the session's log function: to wait for that to end would be for ever.
pub fn check_outside(session: Handle) -> Result<(), Code> {
    let inside = INSIDE.with(|inside| inside.borrow().contains(&session.id));
    if inside { Err(Code::ERROR_BUSY) } else { Ok(()) }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_poll(session: Handle) -> Code {
    with_main(session, |side| {
        let _inside = Inside::new(session);
        side.poll();
        Ok(Code::OK)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hapflow_engine::TickTimes;
    use hapflow_realtime::Refusal;

    fn told(tool: &mut ToolTold, faults: FaultSet) -> Vec<String> {
        let mut lines = Lines::new();
        tool.faults(faults, &mut lines);
        lines.into_iter().map(|(level, text)| format!("{} {text}", level as u32)).collect()
    }

    #[test]
    fn faults_are_told_as_they_come_and_go_and_everyday_ones_once() {
        let mut tool = ToolTold::default();
        let stop = told(&mut tool, FaultSet::EMERGENCY_STOP | FaultSet::SLEW_LIMITED);
        assert_eq!(stop.len(), 2);
        assert_eq!(stop[0], "1 fault: emergency stop; no force until the faults are cleared");
        assert!(stop[1].starts_with("2 remark: "));
        assert!(told(&mut tool, FaultSet::EMERGENCY_STOP).is_empty());
        assert!(told(&mut tool, FaultSet::EMERGENCY_STOP | FaultSet::SLEW_LIMITED).is_empty());
        assert_eq!(told(&mut tool, FaultSet::NONE), ["3 no more: emergency stop"]);
        assert_eq!(told(&mut tool, FaultSet::STALE).len(), 1);
        assert_eq!(told(&mut tool, FaultSet::NONE).len(), 1);
    }

    #[test]
    fn a_servos_priority_is_told_once_and_its_end_once() {
        let mut tool = ToolTold::default();
        let refused = Grant::Refused(Refusal::NotSupported);
        let mut told = |runs| {
            let pace = ServoPace { priority: refused.clone(), runs, ticks: TickTimes::default() };
            let mut lines = Lines::new();
            tool.pace(&pace, &mut lines);
            lines.into_iter().map(|(level, text)| (level as u32, text)).collect::<Vec<_>>()
        };
        let first = told(true);
        assert!(first.len() == 1 && first[0].0 == c::HAPFLOW_LOG_WARNING && first[0].1.contains("refused: "));
        assert_eq!(told(true), []);
        assert_eq!(told(false), [(c::HAPFLOW_LOG_ERROR, "the servo has ended".into())]);
        assert_eq!(told(false), []);
    }

    #[test]
    fn what_is_counted_is_told_by_its_growth() {
        let (mut told, mut lines) = (0, Lines::new());
        for now in [0, 3, 3, 5] {
            counted(&mut told, now, "frames", &mut lines);
        }
        let texts: Vec<_> = lines.iter().map(|(_, text)| text.as_str()).collect();
        assert_eq!(texts, ["3 frames (3 so far)", "2 frames (5 so far)"]);
    }
}
