//! The [main] and [any] functions of a session.

use crate::caller::{Buffer, In, Out, Shown, Text};
use crate::code::{Code, Failure, Outcome};
use crate::config::SessionConfig;
use crate::device::take_over;
use crate::fence::{fence, fence_main};
use crate::fluid::FluidSide;
use crate::handle::Handle;
use crate::hooks;
use crate::log::{Log, check_outside};
use crate::obstacle::ObstacleSide;
use crate::report::Report;
use crate::servo::ServoSide;
use crate::servo_pace::{Paces, ServoPaceRecord};
use crate::setting_info::{Names, Panel, SettingInfo, plain};
use crate::table::{LIBRARY, Parts};
use glam::DVec3;
use hapflow_devices::HapticDevice;
use hapflow_engine::{
    BodyList, BodyReport, Control, Drive, Scene, Session, SessionOptions, Value, open_device,
};
use hapflow_fluid::ParticleView;
use hapflow_haptics::{FaultSet, Touching};
use hapflow_realtime::Faultable;
use std::ffi::c_char;
use std::ops::ControlFlow;

/// Main's part of a session.
pub struct MainSide {
    pub session: Session,
    control: Control,
    names: Names,
    paces: Paces,
    log: Option<Log>,
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
        let servo = self.session.report_of(tool as usize).ok_or_else(|| self.no_tool(tool))?;
        report.fill(&Report::of(&servo, &self.session.fluid_report(), self.control.faults()))?;
        Ok(Code::OK)
    }

    fn pace(&mut self, tool: u32, pace: Out<ServoPaceRecord>) -> Result<Code, Failure> {
        pace.check_record()?;
        if tool as usize >= self.session.tool_count() {
            return Err(self.no_tool(tool));
        }
        pace.fill(&self.paces.of(&mut self.session, tool as usize))?;
        Ok(Code::OK)
    }

    /// Tells the host what has happened, if it listens.
    pub fn poll(&mut self) {
        if let Some(log) = &mut self.log {
            log.poll(&mut self.session, &self.control);
        }
    }

    /// What a tool touches.
    pub fn touching(&mut self, tool: u32) -> Result<Touching, Failure> {
        self.session.touching_of(tool as usize).ok_or_else(|| self.no_tool(tool))
    }

    /// A body of one of the scene's lists, whose things are called `what`.
    pub fn body(&mut self, (list, what): (BodyList, &str), index: u32) -> Result<BodyReport, Failure> {
        let reports = self.session.body_reports_of(list);
        reports.get(index as usize).copied().ok_or_else(|| Failure::index(what, index, reports.len() as u32))
    }

    fn no_tool(&self, tool: u32) -> Failure {
        Failure::index("tool", tool, self.session.tool_count() as u32)
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
        self.control.raise(FaultSet::PANIC);
    }
}

/// What any thread may reach of a session.
pub struct AnySide {
    control: Control,
    servo_drive: Drive,
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

    /// A state was refused that is no tool's: every tool has to stop, if it is the host that ticks them.
    pub fn refuse_input(&self) -> Result<(), Code> {
        if self.servo_drive == Drive::Owned {
            return Err(Code::ERROR_DRIVE);
        }
        self.control.raise(FaultSet::NON_FINITE_INPUT);
        Ok(())
    }
}

/// The device of a scene, ready to be used; one that has to be homed waits for the person, whom its lights lead.
pub fn open_ready(scene: &Scene) -> Result<Box<dyn HapticDevice>, Failure> {
    let mut device = open_device(scene)?;
    device.prepare(&mut |_| ControlFlow::Continue(()))?;
    Ok(device)
}

/// The devices of an owned servo: those of the host, else the scene's own.
fn devices(config: &SessionConfig, scene: &Scene) -> Result<Vec<Box<dyn HapticDevice>>, Failure> {
    let given = config.devices()?;
    if config.servo_drive()? == Drive::Host {
        return Ok(Vec::new());
    }
    if given.is_empty() {
        return Ok(vec![open_ready(scene)?]);
    }
    let tools = scene.tools().count();
    if given.len() > tools {
        let text = format!("device_count = {}: the scene has {tools} tools", given.len());
        return Err(Failure { code: Code::ERROR_VALUE, text });
    }
    take_over(&given)
}

/// Makes a session.
fn open(config: &SessionConfig) -> Result<Parts, Failure> {
    let (servo_drive, fluid_drive) = (config.servo_drive()?, config.fluid_drive()?);
    let scene = config.scene()?;
    // Whatever may be refused is, before any device is taken over.
    scene.check()?;
    let log = config.log(&scene)?;
    let devices = devices(config, &scene)?;
    let names = devices.iter().map(|d| Shown::new(d.name())).collect();
    let options = SessionOptions {
        servo_drive,
        fluid_drive,
        threads: config.threads(),
        devices,
        tape: config.tape()?,
        ..SessionOptions::hosted()
    };
    let mut session = Session::open(&scene, options)?;
    let control = session.control();
    let tools = 0..session.tool_count();
    let mut servo = |tool| session.take_servo_of(tool).filter(|_| servo_drive == Drive::Host);
    let servos: Vec<_> = tools.map(|tool| ServoSide::new(servo(tool), control.clone())).collect();
    let fluid = FluidSide::new(session.take_fluid(), control.clone(), scene.run.fluid_hz);
    let Some(mover) = session.take_obstacles() else {
        return Err(Failure { code: Code::ERROR_SCENE, text: "the session's obstacles are taken".into() });
    };
    let obstacle = ObstacleSide::new(mover, control.clone());
    let (tools, obstacles) = (servos.len() as u32, obstacle.count());
    Ok(Parts {
        servos,
        fluid,
        obstacle,
        any: AnySide { control: control.clone(), servo_drive, tools, obstacles },
        main: MainSide {
            paces: Paces::new(&mut session, names),
            log,
            session,
            control,
            names: Names::of(&scene),
            panel: None,
            particles: Taken::default(),
        },
    })
}

pub fn with_main(session: Handle, body: impl FnOnce(&mut MainSide) -> Result<Code, Failure>) -> Code {
    fence_main(|| {
        let mut side = LIBRARY.main(session)?;
        hooks::panic_if_asked();
        body(&mut side)
    })
}

pub fn with_any(session: Handle, body: impl FnOnce(&AnySide) -> Outcome) -> Code {
    fence(|| body(&*LIBRARY.any(session)?))
}

/// Refuses numbers that are not finite.
pub fn finite(path: &str, numbers: &[f64]) -> Result<(), Failure> {
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
        hooks::panic_if_asked();
        session.put(LIBRARY.place(|| open(&config))?)?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_destroy(session: Handle) -> Code {
    fence_main(|| {
        check_outside(session)?;
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
        let (path, value) = (path.read()?, value.whole()?);
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
pub extern "C" fn hapflow_session_servo_pace(session: Handle, tool: u32, pace: Out<ServoPaceRecord>) -> Code {
    with_main(session, |side| side.pace(tool, pace))
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
        side.control.clear_faults();
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_limit_force(session: Handle, max_force: f64, max_torque: f64) -> Code {
    with_any(session, |side| {
        if !max_force.is_finite() || !max_torque.is_finite() {
            return Err(Code::ERROR_NOT_FINITE);
        }
        let limited = side.control.limit_force(max_force, max_torque);
        limited.map(|()| Code::OK).map_err(|_| Code::ERROR_VALUE)
    })
}
