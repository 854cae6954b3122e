//! A session: a scene made to run, its two halves, and what main may do with it.

use crate::control::Control;
use crate::fluid_unit::{BodyReport, FluidReport, FluidUnit};
use crate::obstacles::{ObstacleMover, Obstacles, obstacle_poses};
use crate::parts::Parts;
use crate::recorder::{Recorded, Recorder, Tape, make_files};
use crate::scene::{Scene, ToolSettings};
use crate::servo::{ServoReport, ServoSettings, ServoUnit};
use crate::shared::{Shared, servo_settings};
use crate::threads::{FluidPace, FluidThread, ServoPace, ServoThread};
use crate::tick_times::TickTimes;
use crate::tool_lane::ToolLane;
use crate::touch::{SolidPaths, Touch};
use crate::{BackendKind, SceneError, Value};
use glam::DVec3;
use hapflow_devices::{DeviceError, HapticDevice};
use hapflow_fluid::{
    AnalyticJet, BodyConfig, BodyLoad, BodySample, CpuBackend, FluidBackend, FluidConfig, FluidError,
    ParticleView, Surroundings,
};
use hapflow_haptics::{Filter, LocalModel, Rendering, SafetyGate, ToolState, Touching, Wrench};
use hapflow_realtime::{
    Clock, HostClock, LatestReader, LatestWriter, RealtimeStatus, RingConsumer, SharedFlags, latest, ring,
};
use std::path::Path;
use std::sync::Arc;

/// Who drives a half of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// The session's own thread, in real time.
    Owned,
    /// The host: it takes the half and calls it.
    Host,
}

/// How a session is opened.
pub struct SessionOptions {
    /// Who ticks the servo. `Owned` needs a device.
    pub servo_drive: Drive,
    /// Who steps the fluid.
    pub fluid_drive: Drive,
    /// Worker threads of the fluid; 0 takes all cores but one, and of two both.
    pub threads: usize,
    /// A fluid of the caller's, made of the scene's [`fluid_config`](Scene::fluid_config); none takes the one that the scene
    /// names.
    pub backend: Option<Box<dyn FluidBackend>>,
    /// The devices of an owned servo, in the order of the scene's tools: a thread for each.
    pub devices: Vec<Box<dyn HapticDevice>>,
    /// The clock of owned threads. An owned fluid under a host's servo keeps the servo's time instead: its
    /// ticks say what time it is.
    pub clock: Arc<dyn Clock>,
    /// Ticks that a recording may fall behind; with 0 nothing can be recorded. See [`Session::record`] and
    /// [`Session::take_tape`].
    pub tape: usize,
    /// What plugins bring, of which the scene takes what it names.
    pub parts: Parts,
}

impl std::fmt::Debug for SessionOptions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SessionOptions").field("servo_drive", &self.servo_drive).finish_non_exhaustive()
    }
}

impl SessionOptions {
    /// Both halves driven by the host.
    pub fn hosted() -> Self {
        Self {
            servo_drive: Drive::Host,
            fluid_drive: Drive::Host,
            threads: 0,
            backend: None,
            devices: Vec::new(),
            clock: Arc::new(hapflow_realtime::RealClock::new()),
            tape: 0,
            parts: Parts::default(),
        }
    }
}

/// Bodies that a scene lists together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyList {
    /// Tools, the first first.
    Tools,
    /// Obstacles.
    Obstacles,
    /// What floats or sinks.
    Free,
}

/// Threads that the session owns, if any.
#[derive(Default)]
struct Owned {
    servos: Vec<ServoThread>,
    fluid: Option<FluidThread>,
}

/// Main's ends of the ways from and to one tool's servo.
struct ToolEnds {
    servo: Option<ServoUnit>,
    report: LatestReader<ServoReport>,
    /// Where the solids are felt.
    touching: Option<LatestReader<Touching>>,
    tape: Option<Tape>,
}

/// A session. Thread: main.
pub struct Session {
    shared: Arc<Shared>,
    control: Control,
    tools: Vec<ToolEnds>,
    fluid_report: LatestReader<FluidReport>,
    bodies: LatestReader<Vec<BodyReport>>,
    /// How many of them are obstacles.
    obstacles: usize,
    fluid: Option<FluidUnit>,
    mover: Option<ObstacleMover>,
    owned: Owned,
    /// Why an owned servo lost its device, once it was stopped.
    lost: Option<DeviceError>,
    recorder: Option<Recorder>,
}

impl std::fmt::Debug for Session {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").field("control", &self.control).finish_non_exhaustive()
    }
}

impl Session {
    /// Makes a session of `scene`; owned halves start at once.
    ///
    /// # Errors
    /// A scene that cannot be run, an owned servo without a device, or a thread that could not be started.
    pub fn open(scene: &Scene, mut options: SessionOptions) -> Result<Self, SceneError> {
        scene.check()?;
        let threads = if options.threads == 0 { default_threads() } else { options.threads };
        let config = scene.fluid_config(threads);
        config.check()?;
        let control = Control::new(scene);
        let (mut tools, mut lanes, mut writers, mut felt) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (tool, clear) in scene.tools().zip(&control.clear) {
            let opened = open_tool(scene, tool, &control, clear, &options)?;
            tools.push(opened.ends);
            lanes.push(opened.lane);
            writers.push(opened.settings);
            felt.extend(opened.solids);
        }
        let shared = Arc::new(Shared::new(scene, control.limit.clone(), threads, writers));
        let (report, fluid_report) = latest(FluidReport::default());
        let at_rest =
            |b: &BodyConfig| BodyReport { state: BodySample::at(b.position), load: BodyLoad::default() };
        let (bodies_in, bodies) = latest(config.world.bodies.iter().map(at_rest).collect::<Vec<_>>());
        let (mover, poses) = obstacle_poses(scene.obstacles.len());
        let backend = match options.backend.take() {
            Some(backend) => backend,
            None => options.parts.open_backend(scene, &config)?,
        };
        let fluid = FluidUnit {
            backend,
            obstacles: Obstacles::new(
                poses,
                &config.world.bodies[lanes.len()..][..scene.obstacles.len()],
                felt,
            ),
            tools: lanes,
            report,
            bodies: bodies_in,
            flags: control.flags.clone(),
            shared: Arc::clone(&shared),
            seen: 0,
            config,
            frame_s: 1.0 / scene.run.fluid_hz,
            newest: FluidReport::default(),
            around: Surroundings::default(),
        };
        let (fluid, mover, owned) = (Some(fluid), Some(mover), Owned::default());
        let obstacles = scene.obstacles.len();
        let mut session = Self {
            shared,
            control,
            tools,
            fluid_report,
            bodies,
            obstacles,
            fluid,
            mover,
            owned,
            lost: None,
            recorder: None,
        };
        session.start(options)?;
        Ok(session)
    }

    fn start(&mut self, options: SessionOptions) -> Result<(), SceneError> {
        let SessionOptions { servo_drive, fluid_drive, devices, clock, .. } = options;
        if let Some(fluid) = self.fluid.take_if(|_| fluid_drive == Drive::Owned) {
            self.owned.fluid = Some(match servo_drive {
                Drive::Host => {
                    let host = Arc::new(HostClock::new());
                    for servo in self.tools.iter_mut().filter_map(|t| t.servo.as_mut()) {
                        servo.pace = Some(Arc::clone(&host));
                    }
                    FluidThread::start(fluid, Arc::clone(&host) as Arc<dyn Clock>, Some(host))?
                }
                Drive::Owned => FluidThread::start(fluid, Arc::clone(&clock), None)?,
            });
        }
        if servo_drive == Drive::Owned {
            self.start_servos(devices, &clock)?;
        }
        Ok(())
    }

    /// One thread a device, for the first tools; a tool without a device stays where it is.
    fn start_servos(
        &mut self,
        devices: Vec<Box<dyn HapticDevice>>,
        clock: &Arc<dyn Clock>,
    ) -> Result<(), SceneError> {
        if devices.is_empty() || devices.len() > self.tools.len() {
            let (devices, tools) = (devices.len(), self.tools.len());
            let what =
                format!("an owned servo needs a device, and each a tool: {devices} devices, {tools} tools");
            return Err(SceneError::Refused(what));
        }
        for (ends, device) in self.tools.iter_mut().zip(devices) {
            if let Some(servo) = ends.servo.take() {
                self.owned.servos.push(ServoThread::start(servo, device, Arc::clone(clock))?);
            }
        }
        Ok(())
    }

    /// How many tools the scene has.
    pub fn tool_count(&self) -> usize {
        self.tools.len()
    }

    /// The first tool's half of the servo, once, if the host drives it.
    pub fn take_servo(&mut self) -> Option<ServoUnit> {
        self.take_servo_of(0)
    }

    /// The half of the servo for tool `tool` (from 0), once, if the host drives it. Each may have a thread of its
    /// own.
    pub fn take_servo_of(&mut self, tool: usize) -> Option<ServoUnit> {
        self.tools.get_mut(tool)?.servo.take()
    }

    /// The fluid's half, once, if the host drives it.
    pub fn take_fluid(&mut self) -> Option<FluidUnit> {
        self.fluid.take()
    }

    /// The hold on the scene's obstacles, once: for the thread that moves them.
    pub fn take_obstacles(&mut self) -> Option<ObstacleMover> {
        self.mover.take()
    }

    /// Every tick's report of tool `tool` (from 0) in order, once, if the session was opened with a tape.
    pub fn take_tape(&mut self, tool: usize) -> Option<RingConsumer<ServoReport>> {
        self.tools.get_mut(tool)?.tape.take()
    }

    /// Writes every tick of every tool to a file from now on, in whatever drive: see [`TickWriter`](crate::TickWriter).
    /// `path` is the first tool's file; any other's has its number before the extension. A thread of its own writes;
    /// no servo waits for it.
    ///
    /// # Errors
    /// A file that cannot be made, a recording that is under way, or a session without a tape.
    pub fn record(&mut self, path: &Path) -> Result<(), SceneError> {
        if self.recorder.is_some() {
            return Err(SceneError::Recording("one is under way: stop it first"));
        }
        if self.tools.iter().any(|t| t.tape.is_none()) {
            return Err(SceneError::Recording("the session was opened without a tape, or it was taken"));
        }
        let files = make_files(path, self.tools.len())?;
        let tapes = self.tools.iter_mut().filter_map(|t| t.tape.take()).collect();
        self.recorder = Some(Recorder::start(tapes, files)?);
        Ok(())
    }

    /// Ends the recording with the newest tick, and says what it came to.
    ///
    /// # Errors
    /// No recording, or one that could not be written to its end.
    pub fn stop_recording(&mut self) -> Result<Recorded, SceneError> {
        let recorder = self.recorder.take().ok_or(SceneError::Recording("there is none to stop"))?;
        let (tapes, result) = recorder.stop();
        for (tool, tape) in self.tools.iter_mut().zip(tapes) {
            tool.tape = Some(tape);
        }
        result
    }

    /// What any thread may do with the session.
    pub fn control(&self) -> Control {
        self.control.clone()
    }

    /// Sets a live setting; it acts from the next fluid frame and the next tick on. The limits of the gate can only
    /// be lowered below those of the scene.
    ///
    /// # Errors
    /// What the setting's range, or stability, refuses; everything stays as it was.
    pub fn set(&self, path: &str, value: &Value) -> Result<(), SceneError> {
        self.shared.set(path, value)
    }

    /// The value of a setting as it stands.
    ///
    /// # Errors
    /// An unknown path.
    pub fn get(&self, path: &str) -> Result<Value, SceneError> {
        self.shared.get(path)
    }

    /// The first tool's newest tick.
    pub fn report(&mut self) -> ServoReport {
        self.report_of(0).unwrap_or_default()
    }

    /// The newest tick of tool `tool` (from 0), if there is such a tool.
    pub fn report_of(&mut self, tool: usize) -> Option<ServoReport> {
        let report = &mut self.tools.get_mut(tool)?.report;
        report.update();
        Some(*report.get())
    }

    /// What tool `tool` (from 0) touched at its newest tick, and its proxy; if there is such a tool. Where its scene's
    /// solids are not felt, the proxy is its body in the fluid, and it touches nothing.
    pub fn touching_of(&mut self, tool: usize) -> Option<Touching> {
        let ends = self.tools.get_mut(tool)?;
        if let Some(touching) = &mut ends.touching {
            touching.update();
            return Some(*touching.get());
        }
        let report = self.report_of(tool)?;
        Some(Touching::nothing(&ToolState { position: report.body, ..report.tool }))
    }

    /// The newest fluid frame.
    pub fn fluid_report(&mut self) -> FluidReport {
        self.fluid_report.update();
        *self.fluid_report.get()
    }

    /// Tools, obstacles and free bodies, in this order, at the end of the newest fluid frame.
    pub fn body_reports(&mut self) -> &[BodyReport] {
        self.bodies.update();
        self.bodies.get()
    }

    /// Those of one list.
    pub fn body_reports_of(&mut self, list: BodyList) -> &[BodyReport] {
        let (tools, obstacles) = (self.tools.len(), self.obstacles);
        let all = self.body_reports();
        match list {
            BodyList::Tools => &all[..tools],
            BodyList::Obstacles => &all[tools..tools + obstacles],
            BodyList::Free => &all[tools + obstacles..],
        }
    }

    /// Asks for the particles; they come with the next fluid frame.
    pub fn request_particles(&self) {
        self.shared.want_snapshot();
    }

    /// How many requests for particles were answered so far; a look at it copies nothing.
    pub fn particles_answered(&self) -> u64 {
        self.shared.answered()
    }

    /// Copies the particles of the last answered request, and says how many requests were answered so far.
    pub fn particles(&self, view: &mut ParticleView) -> u64 {
        self.shared.snapshot(view);
        self.particles_answered()
    }

    /// What the system granted the first owned servo thread.
    pub fn realtime_status(&self) -> Option<RealtimeStatus> {
        self.owned.servos.first().map(ServoThread::status)
    }

    /// How the owned servo of tool `tool` (from 0) keeps time; none if it is not owned.
    pub fn servo_pace(&mut self, tool: usize) -> Option<ServoPace> {
        self.owned.servos.get_mut(tool).map(ServoThread::pace)
    }

    /// How the fluid keeps up, if it is owned.
    pub fn fluid_pace(&mut self) -> Option<FluidPace> {
        self.owned.fluid.as_mut().map(FluidThread::pace)
    }

    /// Whether all owned servos still tick; one ends by itself when its device is lost.
    pub fn servo_runs(&self) -> bool {
        !self.owned.servos.is_empty() && self.owned.servos.iter().all(|s| !s.is_finished())
    }

    /// Stops owned threads, the servos first, with zero force, and a recording; says how the first of them and the fluid kept
    /// time.
    pub fn close(&mut self) -> (TickTimes, FluidPace) {
        let mut first = None;
        for mut servo in self.owned.servos.drain(..) {
            let (ticks, lost) = servo.stop();
            first.get_or_insert(ticks);
            self.lost = self.lost.take().or(lost);
        }
        let pace = self.owned.fluid.take().map(|mut f| f.stop()).unwrap_or_default();
        // Who asks for it by `stop_recording` gets its result; here nobody does.
        let _ = self.stop_recording();
        (first.unwrap_or_default(), pace)
    }

    /// Why the first owned servo that lost its device did, once the session is closed.
    pub fn take_lost(&mut self) -> Option<DeviceError> {
        self.lost.take()
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.close();
    }
}

/// Acceleration of a falling body, m/s²: the device stands on the earth, wherever its scene is.
const STANDARD_GRAVITY: f64 = 9.80665;

/// All cores but one, which the servo needs; of two, both: the servo takes precedence and little time.
fn default_threads() -> usize {
    std::thread::available_parallelism().map_or(1, |n| (n.get() - 1).max(n.get().min(2)))
}

/// Everything that one tool needs.
struct OpenedTool {
    ends: ToolEnds,
    lane: ToolLane,
    /// Main's way to its servo.
    settings: LatestWriter<ServoSettings>,
    /// The fluid's way to it, where the solids are felt.
    solids: Option<LatestWriter<SolidPaths>>,
}

fn open_tool(
    scene: &Scene,
    tool: &ToolSettings,
    control: &Control,
    clear: &SharedFlags,
    SessionOptions { tape, parts, .. }: &SessionOptions,
) -> Result<OpenedTool, SceneError> {
    let first = servo_settings(scene, tool);
    let (settings_in, settings) = latest(first);
    let (model_in, model) = latest(LocalModel::default());
    let (report_in, report) = latest(ServoReport::default());
    // Two seconds of ticks: more than any fluid frame, and than the gate holds a stale force.
    let (path, path_out) = ring(2048);
    let (tape_in, tape) = (*tape > 0).then(|| ring(*tape)).unzip();
    let mapping = scene.mapping()?;
    let (touch, solids, touching) = match Touch::open(scene, tool) {
        Some((touch, solids, touching)) => (Some(touch), Some(solids), Some(touching)),
        None => (None, None, None),
    };
    let servo = ServoUnit {
        last_device: mapping.device_state(ToolState::at(tool.position)),
        mapping,
        rendering: Rendering::new(scene.coupling()),
        lift: Wrench::from_force(DVec3::Y * (scene.mapping.carried_mass * STANDARD_GRAVITY)),
        clutch: scene.clutch(),
        filter: Filter::new(&scene.filter(), 1000.0)?,
        gate: SafetyGate::new(scene.gate)?,
        limit: control.limit.clone(),
        force_scale: first.force_scale,
        reach: first.reach,
        touch,
        frame_s: 1.0 / scene.run.fluid_hz,
        path,
        model,
        settings,
        flags: control.flags.clone(),
        clear: clear.clone(),
        report: report_in,
        tape: tape_in,
        newest: ServoReport::default(),
        started_s: 0.0,
        pace: None,
    };
    let lane = ToolLane::new(parts.make_coupling(scene)?, path_out, model_in, tool);
    let ends = ToolEnds { servo: Some(servo), report, touching, tape };
    Ok(OpenedTool { ends, lane, settings: settings_in, solids })
}

/// The fluid that `scene` names, of `config`.
///
/// # Errors
/// What the fluid refuses.
pub fn open_backend(scene: &Scene, config: &FluidConfig) -> Result<Box<dyn FluidBackend>, FluidError> {
    Ok(match scene.run.backend {
        BackendKind::Cpu => Box::new(CpuBackend::new(config)?),
        BackendKind::AnalyticJet => Box::new(AnalyticJet::new(config)?),
    })
}
