//! One fluid frame: newest settings, tool path, backend, local model. Thread: fluid, one at a time.

use crate::obstacles::Obstacles;
use crate::servo::PathSample;
use crate::session::{Live, Shared};
use glam::DVec3;
use hapflow_fluid::{BodyDrive, BodyMotion, BodySample, FluidBackend, FrameInput, FrameOutput, ParticleView};
use hapflow_haptics::{BodyState, Coupling, Drive, FaultSet, LocalModel, ToolState, Wrench};
use hapflow_realtime::{LatestWriter, RingConsumer, SharedFlags};
use std::sync::Arc;

/// What came of the newest fluid frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FluidReport {
    /// Number of the frame, from 1.
    pub frame: u64,
    /// Fluid time at its end, s.
    pub time_s: f64,
    /// Particles.
    pub particles: usize,
    /// Sub-steps of the frame.
    pub substeps: usize,
    /// Sub-steps of all frames.
    pub total_substeps: u64,
    /// Highest particle speed, m/s.
    pub max_speed: f64,
    /// Load of the fluid on the tool in that frame, before the coupling.
    pub load: Wrench,
    /// Frames that hit a limit of the solver.
    pub degraded: u64,
}

/// The fluid's half of a session.
pub struct FluidUnit {
    pub(crate) backend: Box<dyn FluidBackend>,
    pub(crate) coupling: Box<dyn Coupling>,
    pub(crate) path: RingConsumer<PathSample>,
    pub(crate) model: LatestWriter<LocalModel>,
    pub(crate) report: LatestWriter<FluidReport>,
    pub(crate) flags: SharedFlags,
    pub(crate) shared: Arc<Shared>,
    pub(crate) seen: u64,
    pub(crate) live: Live,
    pub(crate) frame_s: f64,
    pub(crate) newest: FluidReport,
    pub(crate) pending: Option<LocalModel>,
    pub(crate) body: BodySample,
    pub(crate) samples: Vec<BodySample>,
    pub(crate) obstacles: Obstacles,
    /// A sample that belongs to the next frame.
    pub(crate) ahead: Option<PathSample>,
    pub(crate) last: PathSample,
    /// Where the last frame's path ended, m.
    pub(crate) path_end: DVec3,
}

impl std::fmt::Debug for FluidUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FluidUnit").field("newest", &self.newest).finish_non_exhaustive()
    }
}

impl FluidUnit {
    /// Length of a frame, s.
    pub fn frame_s(&self) -> f64 {
        self.frame_s
    }

    /// Steps the frame whose tool path ends at `end_s` on the servo's clock. Its model waits for
    /// [`publish`](Self::publish).
    pub fn compute(&mut self, end_s: f64) {
        self.take_settings(end_s);
        let device = self.take_path(end_s);
        let body = self.body_state();
        let drive = match self.coupling.begin_frame(&body, &device, self.frame_s) {
            Drive::Led => BodyDrive::Led,
            Drive::Driven { velocity } => BodyDrive::Driven { velocity },
        };
        let bodies = self.live.config.world.bodies.get(1..).unwrap_or_default();
        let obstacles = self.obstacles.paths(bodies, end_s, self.frame_s);
        let tool = std::iter::once(BodyMotion { drive, path: &self.samples });
        let led = obstacles.iter().map(|path| BodyMotion { drive: BodyDrive::Led, path });
        let motions: Vec<_> = tool.chain(led).collect();
        self.backend.submit(&FrameInput { duration: self.frame_s, bodies: &motions });
        let output = loop {
            match self.backend.poll() {
                Some(output) => break output,
                None => std::thread::yield_now(),
            }
        };
        let (load, end) = read(output);
        self.newest = report(&self.newest, output, load);
        self.body = end.unwrap_or(self.body);
        let wrench = self.coupling.end_frame(&self.body_state(), load, self.frame_s);
        self.flags.raise(FaultSet::FLUID_FAULT.when(!wrench.is_finite()).bits());
        self.pending = Some(LocalModel {
            frame: self.newest.frame,
            path_end_s: end_s,
            published_s: end_s,
            frame_s: self.frame_s,
            wrench: if wrench.is_finite() { wrench } else { Wrench::ZERO },
            body: self.body.position,
        });
        self.report.write(self.newest);
        self.shared.answer_snapshot(&mut *self.backend);
    }

    /// Hands the computed frame's model to the servo, at `now_s` on its clock.
    pub fn publish(&mut self, now_s: f64) {
        if let Some(model) = self.pending.take() {
            self.model.write(LocalModel { published_s: now_s, ..model });
        }
    }

    /// The newest frame.
    pub fn newest(&self) -> &FluidReport {
        &self.newest
    }

    /// Copies the particles out.
    pub fn snapshot(&mut self, view: &mut ParticleView) {
        self.backend.snapshot(view);
    }

    fn take_settings(&mut self, now_s: f64) {
        self.shared.apply_changes_until(now_s);
        let Some(live) = self.shared.newer_than(&mut self.seen) else { return };
        // Main has checked them; a backend that still refuses keeps its old ones and says so.
        match self.backend.configure(&live.config) {
            Ok(()) => self.live = live,
            Err(_) => self.newest.degraded += 1,
        }
    }

    fn body_state(&self) -> BodyState {
        BodyState {
            position: self.body.position,
            velocity: self.body.velocity,
            mass: self.live.mass,
            collision_response: self.live.collision_response,
        }
    }

    /// Fetches the tool's path up to `end_s` into `samples`, from where the last frame ended, and returns the
    /// tool there.
    fn take_path(&mut self, end_s: f64) -> ToolState {
        self.samples.clear();
        self.samples.push(sample(end_s - self.frame_s, &self.tool_at(end_s - self.frame_s)));
        while let Some(next) = self.ahead.take().or_else(|| self.path.pop()) {
            if next.time_s > end_s {
                self.ahead = Some(next);
                break;
            }
            self.last = next;
            if next.time_s > end_s - self.frame_s && self.samples.len() < self.samples.capacity() - 1 {
                self.samples.push(sample(next.time_s, &next.tool));
            }
        }
        let end = self.tool_at(end_s);
        self.samples.push(sample(end_s, &end));
        self.join_path(end_s);
        end
    }

    /// Makes the path begin where the last frame's ended. They differ when frames were skipped: then the way
    /// between is spread over this frame, for a jump would strike the fluid.
    fn join_path(&mut self, end_s: f64) {
        let Some(first) = self.samples.first().copied() else { return };
        let gap = self.path_end - first.position;
        for sample in &mut self.samples {
            let left = ((end_s - sample.time) / self.frame_s).clamp(0.0, 1.0);
            sample.position += gap * left;
            sample.velocity -= gap / self.frame_s;
        }
        self.path_end = self.samples.last().map_or(self.path_end, |s| s.position);
    }

    /// The tool at `time_s`, carried on from its newest sample by at most two frames.
    fn tool_at(&self, time_s: f64) -> ToolState {
        let ahead = (time_s - self.last.time_s).clamp(0.0, 2.0 * self.frame_s);
        let tool = self.last.tool;
        ToolState { position: tool.position + tool.velocity * ahead, ..tool }
    }
}

fn sample(time: f64, tool: &ToolState) -> BodySample {
    BodySample {
        time,
        position: tool.position,
        orientation: tool.orientation,
        velocity: tool.velocity,
        angular_velocity: tool.angular_velocity,
    }
}

fn read(output: &FrameOutput) -> (Wrench, Option<BodySample>) {
    let load = output.loads.first().copied().unwrap_or_default();
    (Wrench { force: load.force(), torque: load.torque }, output.bodies.first().copied())
}

fn report(last: &FluidReport, output: &FrameOutput, load: Wrench) -> FluidReport {
    FluidReport {
        frame: last.frame + 1,
        time_s: output.time,
        particles: output.particles,
        substeps: output.substeps,
        total_substeps: last.total_substeps + output.substeps as u64,
        max_speed: output.max_speed,
        load,
        degraded: last.degraded + u64::from(output.degraded),
    }
}

/// Where a path starts before any sample has come.
pub(crate) fn start_sample(position: DVec3) -> PathSample {
    PathSample { time_s: 0.0, tool: ToolState::at(position) }
}
