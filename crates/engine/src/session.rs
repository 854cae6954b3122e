//! A session: a scene made to run, its two halves, and what main may do with it.

use crate::fluid_unit::{FluidReport, FluidUnit};
use crate::force_limit::ForceLimit;
use crate::obstacles::{ObstacleMover, Obstacles, obstacle_poses};
use crate::recorder::{Recorded, Recorder, Tape, make_files};
use crate::scene::{BackendKind, DeviceKind, MotionOrigin, Scene, ToolSettings};
use crate::servo::{ServoReport, ServoSettings, ServoUnit};
use crate::threads::{FluidPace, FluidThread, ServoPace, ServoThread};
use crate::tick_times::TickTimes;
use crate::tool_lane::ToolLane;
use crate::touch::{SolidPaths, Touch};
use crate::{SceneError, Value, settings};
use glam::DVec3;
use hapflow_devices::{AtEnd, HapticDevice, Motion, NullDevice, Replay, SimulatedHand, TargetScript};
use hapflow_fluid::{AnalyticJet, CpuBackend, FluidBackend, FluidConfig, ParticleView};
use hapflow_haptics::{FaultSet, Filter, LocalModel, RangeError, SafetyGate, ToolState, Touching};
use hapflow_realtime::{
    Clock, HostClock, LatestReader, LatestWriter, RealtimeStatus, RingConsumer, SharedFlags, latest, ring,
};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
    /// The devices of an owned servo, in the order of the scene's tools: a thread for each.
    pub devices: Vec<Box<dyn HapticDevice>>,
    /// The clock of owned threads. An owned fluid under a host's servo keeps the servo's time instead: its
    /// ticks say what time it is.
    pub clock: Arc<dyn Clock>,
    /// Ticks that a recording may fall behind; with 0 nothing can be recorded. See [`Session::record`] and
    /// [`Session::take_tape`].
    pub tape: usize,
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
            devices: Vec::new(),
            clock: Arc::new(hapflow_realtime::RealClock::new()),
            tape: 0,
        }
    }
}

/// The scene as it stands, shared by main and fluid; the servo gets its part wait-free and never waits for this
/// lock.
pub(crate) struct Shared {
    state: Mutex<State>,
    limit: ForceLimit,
    version: AtomicU64,
    threads: usize,
    wanted: AtomicBool,
    view: Mutex<ParticleView>,
    answered: AtomicU64,
}

struct State {
    scene: Scene,
    /// Changes of the scene that are done.
    changed: usize,
    /// One for each tool.
    servo: Vec<LatestWriter<ServoSettings>>,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set(&self, path: &str, value: &Value) -> Result<(), SceneError> {
        let mut state = self.state();
        let mut scene = self.as_it_stands(&state);
        settings::set_live(&mut scene, path, value)?;
        self.limit.check(&scene.gate)?;
        scene.check()?;
        self.install(&mut state, scene);
        Ok(())
    }

    /// The scene, with a force limit that was lowered since in place of its own.
    fn as_it_stands(&self, state: &State) -> Scene {
        Scene { gate: self.limit.applied(state.scene.gate), ..state.scene.clone() }
    }

    fn install(&self, state: &mut State, scene: Scene) {
        state.scene = scene;
        let State { scene, servo, .. } = state;
        for (writer, tool) in servo.iter_mut().zip(scene.tools()) {
            writer.write(servo_settings(scene, tool));
        }
        self.version.fetch_add(1, Ordering::Release);
    }

    /// Applies the scene's own changes that are due. They were checked when the scene was read; one that a
    /// later `set` has made impossible is passed over.
    pub fn apply_changes_until(&self, now_s: f64) {
        let mut state = self.state();
        while let Some(change) = state.scene.changes.get(state.changed).filter(|c| c.at_s <= now_s).cloned() {
            state.changed += 1;
            let mut scene = state.scene.clone();
            let done = change.settings.iter().try_for_each(|(p, v)| settings::set_live(&mut scene, p, v));
            if done.is_ok() && scene.fluid_config(1).check().is_ok() {
                self.install(&mut state, scene);
            }
        }
    }

    /// The fluid's settings, if there are newer ones than `seen`.
    pub fn newer_than(&self, seen: &mut u64) -> Option<FluidConfig> {
        let version = self.version.load(Ordering::Acquire);
        if version == *seen {
            return None;
        }
        *seen = version;
        Some(self.state().scene.fluid_config(self.threads))
    }

    /// Fills the view if main has asked for one.
    pub fn answer_snapshot(&self, backend: &mut dyn FluidBackend) {
        if self.wanted.swap(false, Ordering::AcqRel) {
            backend.snapshot(&mut self.view.lock().unwrap_or_else(PoisonError::into_inner));
            self.answered.fetch_add(1, Ordering::Release);
        }
    }
}

fn servo_settings(scene: &Scene, tool: &ToolSettings) -> ServoSettings {
    ServoSettings { gate: scene.gate, force_scale: tool.force_scale, reach: tool.shape().bounding_radius() }
}

/// What any thread may do with a session: raise and clear faults, and limit its forces.
#[derive(Clone, Debug)]
pub struct Control {
    flags: SharedFlags,
    limit: ForceLimit,
    /// One for each tool, whose gate answers it by itself.
    clear: Vec<SharedFlags>,
}

impl Control {
    /// No force from the next tick on, until [`clear_faults`](Self::clear_faults). Thread: any.
    pub fn emergency_stop(&self) {
        self.raise(FaultSet::EMERGENCY_STOP);
    }

    /// Raises faults, on all tools from their next tick on. Thread: any.
    pub fn raise(&self, faults: FaultSet) {
        self.flags.raise(faults.bits());
    }

    /// Takes back every fault; the force ramps in. Thread: any.
    pub fn clear_faults(&self) {
        self.flags.clear(u32::MAX);
        for tool in &self.clear {
            tool.raise(1);
        }
    }

    /// From the next tick on no tool's force is larger than `max_force_n` (N) and no torque than `max_torque_nm`
    /// (N·m), for the rest of the session: a limit can be lowered and never raised. Thread: any.
    ///
    /// # Errors
    /// A number that is not from 0 to the present limit; nothing changes then.
    pub fn limit_force(&self, max_force_n: f64, max_torque_nm: f64) -> Result<(), RangeError> {
        self.limit.lower(max_force_n, max_torque_nm)
    }

    /// Faults that are raised. Thread: any.
    pub fn faults(&self) -> FaultSet {
        FaultSet::from_bits(self.flags.load())
    }
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
    fluid: Option<FluidUnit>,
    mover: Option<ObstacleMover>,
    owned: Owned,
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
    pub fn open(scene: &Scene, options: SessionOptions) -> Result<Self, SceneError> {
        scene.check()?;
        let threads = if options.threads == 0 { default_threads() } else { options.threads };
        let config = scene.fluid_config(threads);
        config.check()?;
        let control = Control {
            flags: SharedFlags::new(),
            limit: ForceLimit::new(scene.gate),
            clear: scene.tools().map(|_| SharedFlags::new()).collect(),
        };
        let (mut tools, mut lanes, mut writers, mut felt) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (tool, clear) in scene.tools().zip(&control.clear) {
            let opened = open_tool(scene, tool, &control, clear, options.tape)?;
            tools.push(opened.ends);
            lanes.push(opened.lane);
            writers.push(opened.settings);
            felt.extend(opened.solids);
        }
        let shared = Arc::new(Shared {
            state: Mutex::new(State { scene: scene.clone(), changed: 0, servo: writers }),
            limit: control.limit.clone(),
            version: AtomicU64::new(0),
            threads,
            wanted: AtomicBool::new(false),
            view: Mutex::new(ParticleView::default()),
            answered: AtomicU64::new(0),
        });
        let (report, fluid_report) = latest(FluidReport::default());
        let (mover, poses) = obstacle_poses(scene.obstacles.len());
        let fluid = FluidUnit {
            backend: open_backend(scene, &config)?,
            obstacles: Obstacles::new(poses, &config.world.bodies[lanes.len()..], felt),
            tools: lanes,
            report,
            flags: control.flags.clone(),
            shared: Arc::clone(&shared),
            seen: 0,
            config,
            frame_s: 1.0 / scene.run.fluid_hz,
            newest: FluidReport::default(),
        };
        let (fluid, mover, owned) = (Some(fluid), Some(mover), Owned::default());
        let mut session = Self { shared, control, tools, fluid_report, fluid, mover, owned, recorder: None };
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
        settings::get(&self.shared.as_it_stands(&self.shared.state()), path)
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

    /// Asks for the particles; they come with the next fluid frame.
    pub fn request_particles(&self) {
        self.shared.wanted.store(true, Ordering::Release);
    }

    /// How many requests for particles were answered so far; a look at it copies nothing.
    pub fn particles_answered(&self) -> u64 {
        self.shared.answered.load(Ordering::Acquire)
    }

    /// Copies the particles of the last answered request, and says how many requests were answered so far.
    pub fn particles(&self, view: &mut ParticleView) -> u64 {
        view.clone_from(&self.shared.view.lock().unwrap_or_else(PoisonError::into_inner));
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
        let mut ticks = self.owned.servos.drain(..).map(|mut s| s.stop());
        let first = ticks.next().unwrap_or_default();
        ticks.for_each(drop);
        let pace = self.owned.fluid.take().map(|mut f| f.stop()).unwrap_or_default();
        // Who asks for it by `stop_recording` gets its result; here nobody does.
        let _ = self.stop_recording();
        (first, pace)
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.close();
    }
}

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
    tape: usize,
) -> Result<OpenedTool, SceneError> {
    let first = servo_settings(scene, tool);
    let (settings_in, settings) = latest(first);
    let (model_in, model) = latest(LocalModel::default());
    let (report_in, report) = latest(ServoReport::default());
    // Two seconds of ticks: more than any fluid frame, and than the gate holds a stale force.
    let (path, path_out) = ring(2048);
    let (tape_in, tape) = (tape > 0).then(|| ring(tape)).unzip();
    let mapping = scene.mapping()?;
    let (touch, solids, touching) = match Touch::open(scene, tool) {
        Some((touch, solids, touching)) => (Some(touch), Some(solids), Some(touching)),
        None => (None, None, None),
    };
    let servo = ServoUnit {
        last_device: mapping.device_state(ToolState::at(tool.position)),
        mapping,
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
    let lane = ToolLane::new(scene.run.coupling.build(), path_out, model_in, tool.position);
    let ends = ToolEnds { servo: Some(servo), report, touching, tape };
    Ok(OpenedTool { ends, lane, settings: settings_in, solids })
}

fn open_backend(scene: &Scene, config: &FluidConfig) -> Result<Box<dyn FluidBackend>, SceneError> {
    Ok(match scene.run.backend {
        BackendKind::Cpu => Box::new(CpuBackend::new(config)?),
        BackendKind::AnalyticJet => Box::new(AnalyticJet::new(config)?),
    })
}

/// The device that `scene` asks for. Its positions are in the device frame of the scene's mapping.
///
/// # Errors
/// A motion that cannot be read, or a hand that cannot be.
pub fn open_device(scene: &Scene) -> Result<Box<dyn HapticDevice>, SceneError> {
    let mapping = scene.mapping()?;
    let place = |p: DVec3| mapping.device_state(ToolState::at(p)).position;
    let start = place(scene.tool.position);
    Ok(match scene.run.device {
        DeviceKind::Null => Box::new(NullDevice::new(start)),
        DeviceKind::Replay => {
            let motion = motion(&scene.run.motion)?;
            let (motion, start) = match scene.run.motion_origin {
                MotionOrigin::Tool => (motion, start),
                MotionOrigin::Scene => (motion.map(place)?, DVec3::ZERO),
            };
            Box::new(Replay::new(motion, start, AtEnd::Hold)?)
        }
        DeviceKind::Hand => {
            let script: Vec<_> = scene.script.iter().map(|s| to_device(s, &place)).collect();
            let script = TargetScript::new(start, &script, AtEnd::Hold)?;
            Box::new(SimulatedHand::new(scene.hand, script)?)
        }
    })
}

/// The shipped motion of that name, or that of a file.
fn motion(name: &str) -> Result<Motion, SceneError> {
    match Motion::builtin(name) {
        Some(motion) => Ok(motion),
        None => Ok(Motion::load(Path::new(name))?),
    }
}

/// A script's segment, turned from the scene's frame into the device's.
fn to_device(
    segment: &hapflow_devices::Segment,
    place: &impl Fn(DVec3) -> DVec3,
) -> hapflow_devices::Segment {
    use hapflow_devices::Segment;
    match *segment {
        Segment::Hold { duration_s } => Segment::Hold { duration_s },
        Segment::MoveTo { position, duration_s } => Segment::MoveTo { position: place(position), duration_s },
        Segment::Sine { amplitude, frequency_hz, duration_s } => {
            Segment::Sine { amplitude: place(amplitude) - place(DVec3::ZERO), frequency_hz, duration_s }
        }
        Segment::Circle { centre, frequency_hz, duration_s } => {
            Segment::Circle { centre: place(centre), frequency_hz, duration_s }
        }
    }
}
