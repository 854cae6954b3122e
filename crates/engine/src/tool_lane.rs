//! One tool's half on the fluid's side: its path in, its body's motion, its local model out.

use crate::BodyReport;
use crate::scene::ToolSettings;
use crate::servo::PathSample;
use hapflow_fluid::{BodyConfig, BodyDrive, BodyMotion, BodySample, Shape};
use hapflow_haptics::{
    Answer, BodyState, Coupling, Drive, Forecast, FrameEnd, Law, LocalModel, Neighbourhood, ToolState, Wrench,
};
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
    /// Where the last frame's path ended.
    path_end: BodySample,
    forecast: Forecast<TICKS>,
    /// Whether the tool's path is carried on.
    leads: bool,
    /// The way of the frame, for the coupling.
    path_taken: Vec<ToolState>,
    /// Time from the end of a frame until its model is handed over, s, over the last frames.
    delay_s: f64,
    /// Factor on the lift, beside the one on the whole force.
    pub buoyancy_scale: f64,
}

/// Ticks from which a path is carried on.
const TICKS: usize = 40;
/// What leaves at a tick acts until the next, so in the mean half a tick later, s.
const TICK_DELAY_S: f64 = 0.5e-3;
/// Share of the newest frame in the mean delay.
const NEWEST: f64 = 0.2;
/// Points of a path that is carried on.
const POINTS: usize = 8;

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
    /// A lane whose tool rests where `tool` starts until a sample comes.
    pub fn new(
        coupling: Box<dyn Coupling>,
        path: RingConsumer<PathSample>,
        model: LatestWriter<LocalModel>,
        tool: &ToolSettings,
    ) -> Self {
        let position = tool.position;
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
            path_end: BodySample::at(position),
            forecast: Forecast::new(ToolState::at(position)),
            leads: false,
            path_taken: Vec::with_capacity(MOST_SAMPLES + 2),
            delay_s: 0.0,
            buoyancy_scale: tool.buoyancy_scale,
        }
    }

    /// Takes the path of a frame, and lets the coupling say how the body moves.
    pub fn begin_frame(&mut self, config: &BodyConfig, frame: FrameTime) {
        // What goes along with a plate or a rod depends on its direction: with one mass for all of them, a path that is
        // carried on would howl.
        self.leads = self.coupling.leads() && matches!(config.shape, Shape::Sphere { .. });
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

    /// How far round the tool its coupling looks at the fluid, m.
    pub fn looks(&self, config: &BodyConfig) -> Option<f64> {
        self.coupling.looks(config.shape.bounding_radius())
    }

    /// Where the fluid's answer of this frame will be felt.
    fn felt_at(&self, frame: FrameTime) -> ToolState {
        self.forecast.at(frame.end_s + self.delay_s + 0.5 * frame.length_s, self.coupling.bend())
    }

    /// Makes the frame's local model, to wait for [`publish`](Self::publish). False if the force was not finite; it
    /// is zero then.
    pub fn end_frame(
        &mut self,
        config: &BodyConfig,
        BodyReport { state: end, load }: BodyReport,
        around: Option<Neighbourhood<'_>>,
        frame: FrameTime,
    ) -> bool {
        self.body = end;
        self.path_taken.clear();
        self.path_taken.extend(self.samples.iter().map(tool_of));
        let end_of_frame = FrameEnd {
            body: self.body_state(config),
            load: Wrench { force: load.force(), torque: load.torque },
            frame_s: frame.length_s,
            radius: config.shape.bounding_radius(),
            volume: config.shape.volume(),
            buoyancy_scale: self.buoyancy_scale,
            path: &self.path_taken,
            felt_at: self.felt_at(frame),
            around,
        };
        let Answer { wrench, law, added_mass } = self.coupling.end_frame(&end_of_frame);
        let sound = wrench.is_finite() && law.is_finite() && added_mass.is_finite();
        self.pending = Some(LocalModel {
            frame: frame.number,
            path_end_s: frame.end_s + self.lead_s(frame),
            published_s: frame.end_s,
            frame_s: frame.length_s,
            wrench: if sound { wrench } else { Wrench::ZERO },
            law: if sound { law } else { Law::default() },
            added_mass: if sound { added_mass } else { 0.0 },
            body: end.position,
        });
        sound
    }

    /// Hands the waiting model to the servo, at `now_s` on its clock.
    pub fn publish(&mut self, now_s: f64) {
        if let Some(model) = self.pending.take() {
            let delay_s = now_s - model.published_s;
            let share = if model.frame > 1 { NEWEST } else { 1.0 };
            self.delay_s += (delay_s.clamp(0.0, 2.0 * model.frame_s) - self.delay_s) * share;
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
            self.forecast.take(next.time_s, &next.tool);
            if next.time_s > start_s && self.samples.len() <= MOST_SAMPLES {
                self.samples.push(sample(next.time_s, &next.tool));
            }
        }
        if self.leads {
            return self.lead_path(frame);
        }
        let end = self.tool_at(frame.end_s, frame);
        self.samples.push(sample(frame.end_s, &end));
        self.join_path(frame);
        end
    }

    /// How far ahead of the frame's end the path ends, s.
    fn lead_s(&self, frame: FrameTime) -> f64 {
        if !self.leads {
            return 0.0;
        }
        // The frame's mean is late by half of the frame, and blended in over one.
        let late_s = self.coupling.late_s(frame.length_s);
        self.delay_s + late_s + 1.5 * frame.length_s + TICK_DELAY_S
    }

    /// Puts a smooth way from where the last frame's path ended to where the tool will be when this frame is felt in the
    /// place of the samples, and returns the tool there.
    fn lead_path(&mut self, frame: FrameTime) -> ToolState {
        let end = self.forecast.at(frame.end_s + self.lead_s(frame), self.coupling.bend());
        let (from, to) = (self.path_end, sample(frame.end_s, &end));
        let start_s = frame.end_s - frame.length_s;
        self.samples.clear();
        for k in 0..=POINTS {
            let share = k as f64 / POINTS as f64;
            let time = start_s + share * frame.length_s;
            self.samples.push(between(&from, &to, share, frame.length_s, time));
        }
        self.path_end = to;
        end
    }

    /// Makes the path begin where the last frame's ended. They differ when frames were skipped: then the way
    /// between is spread over this frame, for a jump would strike the fluid.
    fn join_path(&mut self, frame: FrameTime) {
        let Some(first) = self.samples.first().copied() else { return };
        let gap = self.path_end.position - first.position;
        for sample in &mut self.samples {
            let left = ((frame.end_s - sample.time) / frame.length_s).clamp(0.0, 1.0);
            sample.position += gap * left;
            sample.velocity -= gap / frame.length_s;
        }
        self.path_end = self.samples.last().copied().unwrap_or(self.path_end);
    }

    /// The tool at `time_s`, carried on from its newest sample by at most two frames.
    fn tool_at(&self, time_s: f64, frame: FrameTime) -> ToolState {
        let ahead = (time_s - self.last.time_s).clamp(0.0, 2.0 * frame.length_s);
        let tool = self.last.tool;
        ToolState { position: tool.position + tool.velocity * ahead, ..tool }
    }
}

fn tool_of(sample: &BodySample) -> ToolState {
    ToolState {
        position: sample.position,
        orientation: sample.orientation,
        velocity: sample.velocity,
        angular_velocity: sample.angular_velocity,
        buttons: 0,
    }
}

/// A cubic through both ends, with their velocities, `length_s` apart.
fn between(from: &BodySample, to: &BodySample, share: f64, length_s: f64, time: f64) -> BodySample {
    let (v0, v1) = (from.velocity * length_s, to.velocity * length_s);
    let way = to.position - from.position;
    let (square, cube) = (3.0 * way - 2.0 * v0 - v1, v0 + v1 - 2.0 * way);
    BodySample {
        time,
        position: from.position + ((cube * share + square) * share + v0) * share,
        velocity: ((cube * (3.0 * share) + square * 2.0) * share + v0) / length_s,
        orientation: from.orientation.slerp(to.orientation, share),
        angular_velocity: from.angular_velocity.lerp(to.angular_velocity, share),
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
