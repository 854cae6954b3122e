//! A session: a scene made to run, its two halves, and what main may do with it.

use crate::fluid_unit::{FluidReport, FluidUnit, start_sample};
use crate::obstacles::{ObstacleMover, Obstacles, obstacle_poses};
use crate::scene::{BackendKind, DeviceKind, Scene};
use crate::servo::{ServoReport, ServoSettings, ServoUnit};
use crate::threads::{FluidPace, FluidThread, ServoThread, TickTimes};
use crate::{SceneError, Value, settings};
use glam::DVec3;
use hapflow_devices::{AtEnd, HapticDevice, Motion, NullDevice, Replay, SimulatedHand, TargetScript};
use hapflow_fluid::{AnalyticJet, BodySample, CpuBackend, FluidBackend, FluidConfig, ParticleView};
use hapflow_haptics::{FaultSet, Filter, LocalModel, SafetyGate, ToolState};
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
    /// The device of an owned servo.
    pub device: Option<Box<dyn HapticDevice>>,
    /// The clock of owned threads. An owned fluid under a host's servo keeps the servo's time instead: its
    /// ticks say what time it is.
    pub clock: Arc<dyn Clock>,
    /// Ticks that a recording may fall behind; 0 records nothing. See [`Session::take_tape`].
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
            device: None,
            clock: Arc::new(hapflow_realtime::RealClock::new()),
            tape: 0,
        }
    }
}

/// Fluid settings as the fluid takes them over between frames.
#[derive(Clone, Debug)]
pub(crate) struct Live {
    pub config: FluidConfig,
    pub mass: f64,
    pub collision_response: f64,
}

impl Live {
    fn of(scene: &Scene, threads: usize) -> Self {
        Self {
            config: scene.fluid_config(threads),
            mass: scene.tool.mass,
            collision_response: scene.tool.collision_response,
        }
    }
}

/// The scene as it stands, shared by main and fluid; the servo gets its part wait-free and never waits for this
/// lock.
pub(crate) struct Shared {
    state: Mutex<State>,
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
    servo: LatestWriter<ServoSettings>,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set(&self, path: &str, value: &Value) -> Result<(), SceneError> {
        let mut state = self.state();
        let mut scene = state.scene.clone();
        settings::set_live(&mut scene, path, value)?;
        scene.check()?;
        self.install(&mut state, scene);
        Ok(())
    }

    fn install(&self, state: &mut State, scene: Scene) {
        state.scene = scene;
        let new = servo_settings(&state.scene);
        state.servo.write(new);
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
    pub fn newer_than(&self, seen: &mut u64) -> Option<Live> {
        let version = self.version.load(Ordering::Acquire);
        if version == *seen {
            return None;
        }
        *seen = version;
        Some(Live::of(&self.state().scene, self.threads))
    }

    /// Fills the view if main has asked for one.
    pub fn answer_snapshot(&self, backend: &mut dyn FluidBackend) {
        if self.wanted.swap(false, Ordering::AcqRel) {
            backend.snapshot(&mut self.view.lock().unwrap_or_else(PoisonError::into_inner));
            self.answered.fetch_add(1, Ordering::Release);
        }
    }
}

fn servo_settings(scene: &Scene) -> ServoSettings {
    ServoSettings { gate: scene.gate, force_scale: scene.tool.force_scale }
}

/// What any thread may do with a session: raise and clear faults.
#[derive(Clone, Debug)]
pub struct Control {
    flags: SharedFlags,
    clear: SharedFlags,
}

impl Control {
    /// No force from the next tick on, until [`clear_faults`](Self::clear_faults). Thread: any.
    pub fn emergency_stop(&self) {
        self.flags.raise(FaultSet::EMERGENCY_STOP.bits());
    }

    /// Takes back every fault; the force ramps in. Thread: any.
    pub fn clear_faults(&self) {
        self.flags.clear(u32::MAX);
        self.clear.raise(1);
    }

    /// Faults that are raised. Thread: any.
    pub fn faults(&self) -> FaultSet {
        FaultSet::from_bits(self.flags.load())
    }
}

/// Threads that the session owns, if any.
#[derive(Default)]
struct Owned {
    servo: Option<ServoThread>,
    fluid: Option<FluidThread>,
}

/// A session. Thread: main.
pub struct Session {
    shared: Arc<Shared>,
    control: Control,
    report: LatestReader<ServoReport>,
    fluid_report: LatestReader<FluidReport>,
    servo: Option<ServoUnit>,
    fluid: Option<FluidUnit>,
    tape: Option<RingConsumer<ServoReport>>,
    mover: Option<ObstacleMover>,
    owned: Owned,
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
        let (settings_writer, settings_reader) = latest(servo_settings(scene));
        let (model_writer, model_reader) = latest(LocalModel::default());
        let (report_writer, report_reader) = latest(ServoReport::default());
        let (fluid_writer, fluid_reader) = latest(FluidReport::default());
        // Two seconds of ticks: more than any fluid frame, and than the gate holds a stale force.
        let (path_in, path_out) = ring(2048);
        let (tape_in, tape) = (options.tape > 0).then(|| ring(options.tape)).unzip();
        let control = Control { flags: SharedFlags::new(), clear: SharedFlags::new() };
        let state = State { scene: scene.clone(), changed: 0, servo: settings_writer };
        let shared = Arc::new(Shared {
            state: Mutex::new(state),
            version: AtomicU64::new(0),
            threads,
            wanted: AtomicBool::new(false),
            view: Mutex::new(ParticleView::default()),
            answered: AtomicU64::new(0),
        });
        let mapping = scene.mapping()?;
        let frame_s = 1.0 / scene.run.fluid_hz;
        let servo = ServoUnit {
            last_device: mapping.device_state(ToolState::at(scene.tool.position)),
            mapping,
            filter: Filter::new(&scene.filter(), 1000.0)?,
            gate: SafetyGate::new(scene.gate)?,
            force_scale: scene.tool.force_scale,
            frame_s,
            path: path_in,
            model: model_reader,
            settings: settings_reader,
            flags: control.flags.clone(),
            clear: control.clear.clone(),
            report: report_writer,
            tape: tape_in,
            newest: ServoReport::default(),
            started_s: 0.0,
            pace: None,
        };
        let live = Live::of(scene, threads);
        live.config.check()?;
        let (mover, poses) = obstacle_poses(scene.obstacles.len());
        let obstacles = Obstacles::new(poses, live.config.world.bodies.get(1..).unwrap_or_default());
        let fluid = FluidUnit {
            backend: open_backend(scene, &live.config)?,
            coupling: scene.run.coupling.build(),
            path: path_out,
            model: model_writer,
            report: fluid_writer,
            flags: control.flags.clone(),
            shared: Arc::clone(&shared),
            seen: 0,
            live,
            frame_s,
            newest: FluidReport::default(),
            pending: None,
            body: BodySample::at(scene.tool.position),
            samples: Vec::with_capacity(2050),
            obstacles,
            ahead: None,
            last: start_sample(scene.tool.position),
            path_end: scene.tool.position,
        };
        let mut session = Self {
            shared,
            control,
            report: report_reader,
            fluid_report: fluid_reader,
            servo: Some(servo),
            fluid: Some(fluid),
            tape,
            mover: Some(mover),
            owned: Owned::default(),
        };
        session.start(options)?;
        Ok(session)
    }

    fn start(&mut self, options: SessionOptions) -> Result<(), SceneError> {
        let SessionOptions { servo_drive, fluid_drive, device, clock, .. } = options;
        if let Some(fluid) = self.fluid.take_if(|_| fluid_drive == Drive::Owned) {
            self.owned.fluid = Some(match &mut self.servo {
                Some(servo) if servo_drive == Drive::Host => {
                    let host = Arc::new(HostClock::new());
                    servo.pace = Some(Arc::clone(&host));
                    FluidThread::start(fluid, Arc::clone(&host) as Arc<dyn Clock>, Some(host))?
                }
                _ => FluidThread::start(fluid, Arc::clone(&clock), None)?,
            });
        }
        if servo_drive == Drive::Owned {
            let device = device.ok_or_else(|| SceneError::Refused("an owned servo needs a device".into()))?;
            if let Some(servo) = self.servo.take() {
                self.owned.servo = Some(ServoThread::start(servo, device, clock)?);
            }
        }
        Ok(())
    }

    /// The servo's half, once, if the host drives it.
    pub fn take_servo(&mut self) -> Option<ServoUnit> {
        self.servo.take()
    }

    /// The fluid's half, once, if the host drives it.
    pub fn take_fluid(&mut self) -> Option<FluidUnit> {
        self.fluid.take()
    }

    /// The hold on the scene's obstacles, once: for the thread that moves them.
    pub fn take_obstacles(&mut self) -> Option<ObstacleMover> {
        self.mover.take()
    }

    /// Every tick's report in order, once, if the session was opened with a tape.
    pub fn take_tape(&mut self) -> Option<RingConsumer<ServoReport>> {
        self.tape.take()
    }

    /// What any thread may do with the session.
    pub fn control(&self) -> Control {
        self.control.clone()
    }

    /// Sets a live setting; it acts from the next fluid frame and the next tick on.
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
        settings::get(&self.shared.state().scene, path)
    }

    /// The newest servo tick.
    pub fn report(&mut self) -> ServoReport {
        self.report.update();
        *self.report.get()
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

    /// Copies the particles of the last answered request, and says how many requests were answered so far.
    pub fn particles(&self, view: &mut ParticleView) -> u64 {
        view.clone_from(&self.shared.view.lock().unwrap_or_else(PoisonError::into_inner));
        self.shared.answered.load(Ordering::Acquire)
    }

    /// What the system granted an owned servo thread.
    pub fn realtime_status(&self) -> Option<RealtimeStatus> {
        self.owned.servo.as_ref().map(ServoThread::status)
    }

    /// Whether an owned servo still ticks; it ends by itself when its device is lost.
    pub fn servo_runs(&self) -> bool {
        self.owned.servo.as_ref().is_some_and(|s| !s.is_finished())
    }

    /// Stops owned threads, the servo first, with zero force, and says how they kept time.
    pub fn close(&mut self) -> (TickTimes, FluidPace) {
        let ticks = self.owned.servo.take().map(|mut s| s.stop()).unwrap_or_default();
        let pace = self.owned.fluid.take().map(|mut f| f.stop()).unwrap_or_default();
        (ticks, pace)
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
            let name = &scene.run.motion;
            let motion = match Motion::builtin(name) {
                Some(motion) => motion,
                None => Motion::load(Path::new(name))?,
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
