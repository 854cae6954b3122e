//! Whole runs: a scene, its device, and every tick recorded.

use crate::{
    BodyReport, Drive, FluidPace, FluidReport, Parts, Recording, Scene, SceneError, ServoReport, Session,
    SessionOptions, TickTimes, TickWriter, VirtualPace, open_device_on,
};
use hapflow_devices::{DeviceError, Pacing};
use hapflow_fluid::ParticleView;
use hapflow_haptics::FaultSet;
use hapflow_realtime::{
    Clock, Grant, RealClock, RealtimeStatus, VirtualClock, lock_memory, process_cpu_s, unlock_memory,
};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The servo's period, s.
pub const TICK_S: f64 = 1e-3;

/// Where a run stands.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Simulated time, s.
    pub time_s: f64,
    /// Its end, s.
    pub duration_s: f64,
    /// The newest tick.
    pub servo: &'a ServoReport,
    /// The newest fluid frame.
    pub fluid: &'a FluidReport,
}

/// How to run.
pub struct RunOptions<'a> {
    /// Worker threads of the fluid; 0 takes all cores but one, and of two both.
    pub threads: usize,
    /// Times at which the particles are kept, s, in order.
    pub pictures_at: &'a [f64],
    /// A file to which every tick is written as it comes: see [`TickWriter`].
    pub record: Option<&'a Path>,
    /// What plugins bring, of which the scene takes what it names.
    pub parts: Parts,
    /// Called with what a person has to do before the device is ready; `Break` gives it up.
    pub guide: &'a mut dyn FnMut(&str) -> ControlFlow<()>,
    /// Called now and then; `Break` ends the run early.
    pub progress: &'a mut dyn FnMut(Progress<'_>) -> ControlFlow<()>,
}

impl std::fmt::Debug for RunOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RunOptions").field("threads", &self.threads).finish_non_exhaustive()
    }
}

/// The particles at one time, and the tool with them.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Simulated time, s.
    pub time_s: f64,
    /// The particles.
    pub particles: ParticleView,
    /// The tick.
    pub servo: ServoReport,
    /// Tools, obstacles and free bodies, in this order.
    pub bodies: Vec<BodyReport>,
}

/// What a run took.
#[derive(Clone, Debug, Default)]
pub struct Timing {
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Wall time, s.
    pub wall_s: f64,
    /// CPU time of all threads, s.
    pub cpu_s: f64,
    /// The servo's ticks.
    pub ticks: TickTimes,
}

/// What came of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Every tick.
    pub recording: Recording,
    /// The last fluid frame.
    pub fluid: FluidReport,
    /// Every fault and remark that any tick had.
    pub faults: FaultSet,
    /// Particles that were kept.
    pub pictures: Vec<Picture>,
    /// What it took.
    pub timing: Timing,
    /// Why the device was lost, if it was.
    pub lost: Option<DeviceError>,
    /// In real time: what the system granted, and how the fluid kept up.
    pub realtime: Option<(RealtimeStatus, FluidPace)>,
}

/// Progress is told once in so many ticks.
const TELL_EVERY: u64 = 20;

/// Runs `scene` on a virtual clock: as fast as it goes, and the same each time. A fluid frame's model is
/// published `run.fluid_delay` frames (one, by default) after its tool path ended, as a real machine would: no free look
/// ahead. A device that sets its own pace sets the clock.
///
/// # Errors
/// What [`Session::open`] refuses, a device that is real, or is not there, or a recording that cannot be written.
pub fn virtual_clock(scene: &Scene, options: RunOptions<'_>) -> Result<Outcome, SceneError> {
    if scene.in_a_hand() {
        return Err(SceneError::Refused("a device in a hand runs in real time only".into()));
    }
    let session_options =
        SessionOptions { threads: options.threads, parts: options.parts, ..SessionOptions::hosted() };
    let clock: Arc<dyn Clock> = Arc::new(VirtualClock::new());
    let mut device = open_device_on(scene, &clock)?;
    device.prepare(options.guide)?;
    let mut session = Session::open(scene, session_options)?;
    let (Some(mut servo), Some(mut fluid)) = (session.take_servo(), session.take_fluid()) else {
        return Err(SceneError::Refused("the session's halves are taken".into()));
    };
    let mut run = Run::begin(scene, options.record)?;
    let mut pace = VirtualPace::new(scene);
    let mut pictures = options.pictures_at.iter().peekable();
    let mut time = RunTime::begin(device.pacing(), clock);
    for n in 0.. {
        let state = device.read(time.due_s(n))?;
        let (time_s, dt_s) = time.tick(n);
        if time_s >= scene.run.duration - 0.5 * TICK_S {
            break;
        }
        pace.advance(&mut fluid, time_s);
        let before = Instant::now();
        let wrench = servo.tick(&state, time_s, dt_s);
        run.outcome.timing.ticks.add(before.elapsed().as_nanos() as u64);
        device.write(wrench, dt_s)?;
        run.record(servo.newest());
        if pictures.next_if(|at| **at <= time_s).is_some() {
            let mut particles = ParticleView::default();
            fluid.snapshot(&mut particles);
            let (servo, bodies) = (*servo.newest(), session.body_reports().to_vec());
            run.outcome.pictures.push(Picture { time_s, particles, servo, bodies });
        }
        if n.is_multiple_of(TELL_EVERY) && run.tell(fluid.newest(), options.progress) {
            break;
        }
    }
    device.close();
    run.end(*fluid.newest())
}

/// The times of a virtual run's ticks: even ones, or those that the device sets.
struct RunTime {
    pacing: Pacing,
    clock: Arc<dyn Clock>,
    begin_ns: u64,
    last_s: f64,
}

impl RunTime {
    fn begin(pacing: Pacing, clock: Arc<dyn Clock>) -> Self {
        let begin_ns = clock.now_ns();
        Self { pacing, clock, begin_ns, last_s: -TICK_S }
    }

    /// When tick `n` is due, s.
    fn due_s(&self, n: u64) -> f64 {
        n as f64 * TICK_S
    }

    /// The time of tick `n`, once the device was read, and since the last, s.
    fn tick(&mut self, n: u64) -> (f64, f64) {
        if self.pacing == Pacing::Timer {
            return (self.due_s(n), TICK_S);
        }
        let time_s = (self.clock.now_ns() - self.begin_ns) as f64 * 1e-9;
        (time_s, time_s - std::mem::replace(&mut self.last_s, time_s))
    }
}

/// Runs `scene` in real time: a servo thread at 1 kHz, a fluid thread, and main that records.
///
/// # Errors
/// What [`Session::open`] refuses, or a recording that cannot be written.
pub fn real_time(scene: &Scene, options: RunOptions<'_>) -> Result<Outcome, SceneError> {
    let clock: Arc<dyn Clock> = Arc::new(RealClock::new());
    let mut device = options.parts.open_device(scene, &clock)?;
    device.prepare(options.guide)?;
    // A page that is fetched from disc in a tick makes it late.
    let memory = Grant::from(lock_memory());
    let session_options = SessionOptions {
        servo_drive: Drive::Owned,
        fluid_drive: Drive::Owned,
        threads: options.threads,
        devices: vec![device],
        clock,
        tape: 8192,
        parts: options.parts,
        ..SessionOptions::hosted()
    };
    let mut session = Session::open(scene, session_options)?;
    let Some(mut tape) = session.take_tape(0) else {
        return Err(SceneError::Refused("the session has no tape".into()));
    };
    let mut run = Run::begin(scene, options.record)?;
    let mut pictures = options.pictures_at.iter().peekable();
    let mut answered = 0;
    loop {
        std::thread::sleep(Duration::from_millis(20));
        while let Some(report) = tape.pop() {
            run.record(&report);
        }
        let newest = session.report();
        if pictures.next_if(|at| **at <= newest.time_s).is_some() {
            session.request_particles();
        }
        answered = run.take_picture(&mut session, answered, newest);
        let stop = run.tell(&session.fluid_report(), options.progress);
        if stop || newest.time_s >= scene.run.duration || !session.servo_runs() {
            break;
        }
    }
    let fluid = session.fluid_report();
    let status = RealtimeStatus { memory, ..session.realtime_status().unwrap_or_default() };
    let (ticks, pace) = session.close();
    run.outcome.lost = session.take_lost();
    // What ended the servo stands in no tick.
    run.outcome.faults |= session.control().faults();
    // Refused or not, nothing is locked any more.
    let _ = unlock_memory();
    while let Some(report) = tape.pop() {
        run.record(&report);
    }
    run.outcome.timing.ticks = ticks;
    run.outcome.realtime = Some((status, pace));
    run.end(fluid)
}

/// A run under way.
struct Run {
    outcome: Outcome,
    duration_s: f64,
    wall: Instant,
    cpu_s: f64,
    file: Option<TickWriter>,
    /// Why the file could not be written on: the run ends then.
    failed: Option<SceneError>,
}

impl Run {
    fn begin(scene: &Scene, record: Option<&Path>) -> Result<Self, SceneError> {
        Ok(Self {
            outcome: Outcome {
                recording: Recording::default(),
                fluid: FluidReport::default(),
                faults: FaultSet::NONE,
                pictures: Vec::new(),
                timing: Timing::default(),
                lost: None,
                realtime: None,
            },
            duration_s: scene.run.duration,
            wall: Instant::now(),
            cpu_s: process_cpu_s(),
            file: record.map(TickWriter::create).transpose()?,
            failed: None,
        })
    }

    fn record(&mut self, report: &ServoReport) {
        self.outcome.faults |= report.faults;
        self.outcome.recording.rows.push(*report);
        self.write(|file| file.write(report));
    }

    /// Does something with the file, if there is one.
    fn write(&mut self, act: impl FnOnce(&mut TickWriter) -> Result<(), SceneError>) {
        if let Some(Err(error)) = self.file.as_mut().map(act) {
            self.failed.get_or_insert(error);
        }
    }

    fn take_picture(&mut self, session: &mut Session, answered: u64, servo: ServoReport) -> u64 {
        if session.particles_answered() == answered {
            return answered;
        }
        let mut particles = ParticleView::default();
        let now = session.particles(&mut particles);
        let bodies = session.body_reports().to_vec();
        self.outcome.pictures.push(Picture { time_s: servo.time_s, particles, servo, bodies });
        now
    }

    /// True when the run is to end.
    fn tell(&self, fluid: &FluidReport, told: &mut dyn FnMut(Progress<'_>) -> ControlFlow<()>) -> bool {
        let Some(servo) = self.outcome.recording.rows.last() else { return false };
        let progress = Progress { time_s: servo.time_s, duration_s: self.duration_s, servo, fluid };
        self.failed.is_some() || told(progress).is_break()
    }

    fn end(mut self, fluid: FluidReport) -> Result<Outcome, SceneError> {
        self.write(TickWriter::flush);
        let timing = &mut self.outcome.timing;
        timing.simulated_s = self.outcome.recording.rows.last().map_or(0.0, |r| r.time_s + TICK_S);
        timing.wall_s = self.wall.elapsed().as_secs_f64();
        timing.cpu_s = process_cpu_s() - self.cpu_s;
        self.outcome.fluid = fluid;
        self.failed.map_or(Ok(self.outcome), Err)
    }
}
