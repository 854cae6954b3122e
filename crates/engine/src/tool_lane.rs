//! One tool's half on the fluid's side: its path in, its body's motion, its local model out.

use crate::servo::PathSample;
use glam::DVec3;
use hapflow_fluid::{BodyConfig, BodyDrive, BodyLoad, BodyMotion, BodySample};
use hapflow_haptics::{BodyState, Coupling, Drive, LocalModel, ToolState, Wrench};
use hapflow_realtime::{LatestWriter, RingConsumer};

/// Samples of a path that a frame takes; more are passed over.
const MOST_SAMPLES: usize = 2048;

/// See the module.
pub(crate) struct ToolLane {
    coupling: Box<dyn Coupling>,
    path: RingConsumer<PathSample>,
    model: LatestWriter<LocalModel>,
    pending: Option<LocalModel>,
    body: BodySample,
    drive: BodyDrive,
    samples: Vec<BodySample>,
    /// A sample that belongs to the next frame.
    ahead: Option<PathSample>,
    last: PathSample,
    /// Where the last frame's path ended, m.
    path_end: DVec3,
}

/// One frame, as the lanes need it.
#[derive(Clone, Copy)]
pub(crate) struct FrameTime {
    /// Number of the frame, from 1.
    pub number: u64,
    /// When its path ends, s.
    pub end_s: f64,
    /// Its length, s.
    pub length_s: f64,
}

impl ToolLane {
    /// A lane whose tool rests at `position` until a sample comes.
    pub fn new(
        coupling: Box<dyn Coupling>,
        path: RingConsumer<PathSample>,
        model: LatestWriter<LocalModel>,
        position: DVec3,
    ) -> Self {
        Self {
            coupling,
            path,
            model,
            pending: None,
            body: BodySample::at(position),
            drive: BodyDrive::Led,
            samples: Vec::with_capacity(MOST_SAMPLES + 2),
            ahead: None,
            last: PathSample { time_s: 0.0, tool: ToolState::at(position) },
            path_end: position,
        }
    }

    /// Takes the path of a frame, and lets the coupling say how the body moves.
    pub fn begin_frame(&mut self, config: &BodyConfig, frame: FrameTime) {
        let device = self.take_path(frame);
        let body = self.body_state(config);
        self.drive = match self.coupling.begin_frame(&body, &device, frame.length_s) {
            Drive::Led => BodyDrive::Led,
            Drive::Driven { velocity } => BodyDrive::Driven { velocity },
        };
    }

    /// The body's motion in the frame that was begun.
    pub fn motion(&self) -> BodyMotion<'_> {
        BodyMotion { drive: self.drive, path: &self.samples }
    }

    /// Makes the frame's local model, to wait for [`publish`](Self::publish). False if the force was not finite; it
    /// is zero then.
    pub fn end_frame(
        &mut self,
        config: &BodyConfig,
        load: BodyLoad,
        end: BodySample,
        frame: FrameTime,
    ) -> bool {
        self.body = end;
        let load = Wrench { force: load.force(), torque: load.torque };
        let wrench = self.coupling.end_frame(&self.body_state(config), load, frame.length_s);
        self.pending = Some(LocalModel {
            frame: frame.number,
            path_end_s: frame.end_s,
            published_s: frame.end_s,
            frame_s: frame.length_s,
            wrench: if wrench.is_finite() { wrench } else { Wrench::ZERO },
            body: end.position,
        });
        wrench.is_finite()
    }

    /// Hands the waiting model to the servo, at `now_s` on its clock.
    pub fn publish(&mut self, now_s: f64) {
        if let Some(model) = self.pending.take() {
            self.model.write(LocalModel { published_s: now_s, ..model });
        }
    }

    fn body_state(&self, config: &BodyConfig) -> BodyState {
        BodyState {
            position: self.body.position,
            velocity: self.body.velocity,
            mass: config.mass,
            collision_response: config.collision_response,
        }
    }

    /// Fetches the tool's path up to the frame's end into `samples`, from where the last frame ended, and returns
    /// the tool there.
    fn take_path(&mut self, frame: FrameTime) -> ToolState {
        let start_s = frame.end_s - frame.length_s;
        self.samples.clear();
        self.samples.push(sample(start_s, &self.tool_at(start_s, frame)));
        while let Some(next) = self.ahead.take().or_else(|| self.path.pop()) {
            if next.time_s > frame.end_s {
                self.ahead = Some(next);
                break;
            }
            self.last = next;
            if next.time_s > start_s && self.samples.len() <= MOST_SAMPLES {
                self.samples.push(sample(next.time_s, &next.tool));
            }
        }
        let end = self.tool_at(frame.end_s, frame);
        self.samples.push(sample(frame.end_s, &end));
        self.join_path(frame);
        end
    }

    /// Makes the path begin where the last frame's ended. They differ when frames were skipped: then the way
    /// between is spread over this frame, for a jump would strike the fluid.
    fn join_path(&mut self, frame: FrameTime) {
        let Some(first) = self.samples.first().copied() else { return };
        let gap = self.path_end - first.position;
        for sample in &mut self.samples {
            let left = ((frame.end_s - sample.time) / frame.length_s).clamp(0.0, 1.0);
            sample.position += gap * left;
            sample.velocity -= gap / frame.length_s;
        }
        self.path_end = self.samples.last().map_or(self.path_end, |s| s.position);
    }

    /// The tool at `time_s`, carried on from its newest sample by at most two frames.
    fn tool_at(&self, time_s: f64, frame: FrameTime) -> ToolState {
        let ahead = (time_s - self.last.time_s).clamp(0.0, 2.0 * frame.length_s);
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
