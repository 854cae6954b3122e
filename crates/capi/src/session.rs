//! The [main] and [any] functions of a session.

use crate::caller::{Buffer, In, Out, Text};
use crate::code::{Code, Failure, Outcome};
use crate::config::SessionConfig;
use crate::fence::{fence, fence_main};
use crate::fluid::FluidSide;
use crate::hooks;
use crate::lane::Faultable;
use crate::obstacle::ObstacleSide;
use crate::report::Report;
use crate::servo::ServoSide;
use crate::setting_info::{Names, Panel, SettingInfo, plain};
use crate::table::{Handle, LIBRARY, Parts};
use glam::DVec3;
use hapflow_engine::{Control, Drive, Scene, Session, SessionOptions, Value};
use hapflow_fluid::ParticleView;
use hapflow_haptics::FaultSet;
use hapflow_realtime::SharedFlags;
use std::ffi::c_char;

/// Faults that the border itself raises: panics, and what it refuses. The servo passes them on at its next tick.
#[derive(Clone)]
pub struct Alarm(SharedFlags);

impl Alarm {
    pub fn raise(&self, faults: FaultSet) {
        self.0.raise(faults.bits());
    }

    pub fn raised(&self) -> FaultSet {
        FaultSet::from_bits(self.0.load())
    }
}

/// Main's part of a session.
pub struct MainSide {
    session: Session,
    control: Control,
    alarm: Alarm,
    names: Names,
    /// Its settings, shown to C; made when it is first asked for.
    panel: Option<Panel>,
    particles: Taken,
}

/// The particles that main has taken from the fluid.
#[derive(Default)]
struct Taken {
    view: ParticleView,
    /// Whether their count was told, and they were not yet fetched.
    told: bool,
}

impl MainSide {
    fn panel(&mut self) -> &Panel {
        self.panel.get_or_insert_with(|| Panel::new(&self.names))
    }

    fn report(&mut self, tool: u32, report: Out<Report>) -> Result<Code, Failure> {
        report.check_record()?;
        let Some(servo) = self.session.report_of(tool as usize) else {
            return Err(Failure::index("tool", tool, self.session.tool_count() as u32));
        };
        let raised = self.control.faults() | self.alarm.raised();
        report.fill(&Report::of(&servo, &self.session.fluid_report(), raised))?;
        Ok(Code::OK)
    }

    /// The particles for a call with room for `capacity`: new ones, unless it follows one that told their count.
    fn positions(&mut self, capacity: usize) -> &[[f32; 3]] {
        if capacity == 0 || !self.particles.told {
            self.session.particles(&mut self.particles.view);
            self.session.request_particles();
        }
        self.particles.told = capacity == 0;
        &self.particles.view.positions
    }
}

impl Faultable for MainSide {
    fn fault(&mut self) {
        self.alarm.raise(FaultSet::PANIC);
    }
}

/// What any thread may reach of a session.
pub struct AnySide {
    control: Control,
    alarm: Alarm,
    tools: u32,
    obstacles: u32,
}

impl AnySide {
    /// How many tools the session has.
    pub fn tools(&self) -> u32 {
        self.tools
    }

    /// How many obstacles it has.
    pub fn obstacles(&self) -> u32 {
        self.obstacles
    }

    /// A state was refused that is no tool's: every tool has to stop.
    pub fn refuse_input(&self) {
        self.alarm.raise(FaultSet::NON_FINITE_INPUT);
    }

    fn clear_faults(&self) {
        self.alarm.0.clear(u32::MAX);
        self.control.clear_faults();
    }
}

/// Makes a session whose servo is the host's.
fn open(scene: &Scene, threads: usize, fluid_drive: Drive) -> Result<Parts, Failure> {
    let options = SessionOptions { threads, fluid_drive, ..SessionOptions::hosted() };
    let mut session = Session::open(scene, options)?;
    let (control, alarm) = (session.control(), Alarm(SharedFlags::new()));
    let servos = (0..session.tool_count()).map_while(|tool| session.take_servo_of(tool));
    let servos: Vec<_> = servos.map(|unit| ServoSide::new(unit, alarm.clone())).collect();
    let fluid = FluidSide::new(session.take_fluid(), alarm.clone(), scene.run.fluid_hz);
    let Some(mover) = session.take_obstacles() else {
        return Err(Failure { code: Code::ERROR_SCENE, text: "the session's obstacles are taken".into() });
    };
    let obstacle = ObstacleSide::new(mover, alarm.clone());
    let (tools, obstacles) = (servos.len() as u32, obstacle.count());
    Ok(Parts {
        servos,
        fluid,
        obstacle,
        any: AnySide { control: control.clone(), alarm: alarm.clone(), tools, obstacles },
        main: MainSide {
            session,
            control,
            alarm,
            names: Names::of(scene),
            panel: None,
            particles: Taken::default(),
        },
    })
}

fn with_main(session: Handle, body: impl FnOnce(&mut MainSide) -> Result<Code, Failure>) -> Code {
    fence_main(|| {
        let mut side = LIBRARY.main(session)?;
        hooks::panic_if_asked();
        body(&mut side)
    })
}

pub fn with_any(session: Handle, body: impl FnOnce(&AnySide) -> Outcome) -> Code {
    fence(|| body(&*LIBRARY.any(session)?))
}

fn finite(path: &str, numbers: &[f64]) -> Result<(), Failure> {
    if numbers.iter().all(|n| n.is_finite()) {
        return Ok(());
    }
    let text = format!("{path} = {numbers:?}: must be finite");
    Err(Failure { code: Code::ERROR_NOT_FINITE, text })
}

fn set(side: &MainSide, path: &str, value: &Value) -> Result<Code, Failure> {
    side.session.set(path, value)?;
    Ok(Code::OK)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_create(config: In<SessionConfig>, session: Out<Handle>) -> Code {
    fence_main(|| {
        LIBRARY.negotiated()?;
        session.check()?;
        let config = config.read(SessionConfig::DEFAULT)?;
        config.check()?;
        let drive = config.fluid_drive()?;
        hooks::panic_if_asked();
        let parts = open(&config.scene()?, config.threads(), drive)?;
        session.put(LIBRARY.place(parts)?)?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_destroy(session: Handle) -> Code {
    fence_main(|| {
        drop(LIBRARY.remove(session)?);
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_set(session: Handle, path: Text, value: f64) -> Code {
    with_main(session, |side| {
        let path = path.read()?;
        finite(path, &[value])?;
        set(side, path, &Value::Number(value))
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_set_vector(session: Handle, path: Text, value: In<[f64; 3]>) -> Code {
    with_main(session, |side| {
        let (path, value) = (path.read()?, value.array()?);
        finite(path, &value)?;
        set(side, path, &Value::Vector(DVec3::from(value)))
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_set_text(session: Handle, path: Text, value: Text) -> Code {
    with_main(session, |side| set(side, path.read()?, &Value::parse(value.read()?)))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_get(session: Handle, path: Text, value: Out<f64>) -> Code {
    with_main(session, |side| {
        value.check()?;
        let path = path.read()?;
        let number = match side.session.get(path)? {
            Value::Number(n) => n,
            Value::Bool(b) => f64::from(u8::from(b)),
            other => {
                let text = format!("{path} = {other}: not a number; hapflow_session_get_text reads it");
                return Err(Failure { code: Code::ERROR_VALUE, text });
            }
        };
        value.put(number)?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_get_text(
    session: Handle,
    path: Text,
    text: Buffer<c_char>,
    capacity: usize,
    length: Out<usize>,
) -> Code {
    with_main(session, |side| {
        let value = side.session.get(path.read()?)?;
        Ok(text.enumerate_text(capacity, length, &plain(value))?)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_setting_count(session: Handle, count: Out<u32>) -> Code {
    with_main(session, |side| {
        count.put(side.panel().len())?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_setting_info(session: Handle, index: u32, info: Out<SettingInfo>) -> Code {
    with_main(session, |side| {
        info.check_record()?;
        info.fill(&side.panel().get(index)?)?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_particles(
    session: Handle,
    positions: Buffer<[f32; 3]>,
    capacity: usize,
    count: Out<usize>,
) -> Code {
    with_main(session, |side| {
        positions.check(capacity, count)?;
        Ok(positions.enumerate(capacity, count, side.positions(capacity))?)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_report(session: Handle, report: Out<Report>) -> Code {
    with_main(session, |side| side.report(0, report))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_report_of(session: Handle, tool: u32, report: Out<Report>) -> Code {
    with_main(session, |side| side.report(tool, report))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_tool_count(session: Handle, count: Out<u32>) -> Code {
    with_any(session, |side| {
        count.put(side.tools())?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_emergency_stop(session: Handle) -> Code {
    with_any(session, |side| {
        side.control.emergency_stop();
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_clear_faults(session: Handle) -> Code {
    with_any(session, |side| {
        side.clear_faults();
        Ok(Code::OK)
    })
}
