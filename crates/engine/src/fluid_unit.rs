//! One fluid frame: newest settings, tool paths, backend, local models. Thread: fluid, one at a time.

use crate::obstacles::Obstacles;
use crate::shared::Shared;
use crate::tool_lane::{FrameTime, ToolLane};
use hapflow_fluid::{
    BodyDrive, BodyLoad, BodyMotion, BodySample, FluidBackend, FluidConfig, FluidSettings, FrameInput,
    FrameOutput, ParticleView, Surroundings,
};
use hapflow_haptics::{FaultSet, Neighbourhood, Wrench};
use hapflow_realtime::{LatestWriter, SharedFlags};
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
    /// Load of the fluid on the first tool in that frame, before the coupling.
    pub load: Wrench,
    /// Frames that hit a limit of the solver.
    pub degraded: u64,
}

/// A body at the end of a fluid frame, and what the fluid did to it in that frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyReport {
    /// Where it is, and how it moves.
    pub state: BodySample,
    /// Mean load of the fluid, by pressure and by friction; on a tool or an obstacle also that of free bodies.
    pub load: BodyLoad,
}

/// The fluid's half of a session.
pub struct FluidUnit {
    pub(crate) backend: Box<dyn FluidBackend>,
    pub(crate) tools: Vec<ToolLane>,
    pub(crate) obstacles: Obstacles,
    pub(crate) report: LatestWriter<FluidReport>,
    /// Of tools, obstacles and free bodies, in this order.
    pub(crate) bodies: LatestWriter<Vec<BodyReport>>,
    pub(crate) flags: SharedFlags,
    pub(crate) shared: Arc<Shared>,
    pub(crate) seen: u64,
    pub(crate) config: FluidConfig,
    pub(crate) frame_s: f64,
    pub(crate) newest: FluidReport,
    /// What is round a tool whose coupling looks.
    pub(crate) around: Surroundings,
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

    /// Steps the frame whose tool paths end at `end_s` on the servo's clock. Its models wait for
    /// [`publish`](Self::publish).
    pub fn compute(&mut self, end_s: f64) {
        self.take_settings(end_s);
        let frame = FrameTime { number: self.newest.frame + 1, end_s, length_s: self.frame_s };
        let (tools, others) = self.config.world.bodies.split_at(self.tools.len());
        let (obstacles, free) = others.split_at(self.obstacles.count());
        for (lane, config) in self.tools.iter_mut().zip(tools) {
            lane.begin_frame(config, frame);
        }
        let paths = self.obstacles.paths(obstacles, end_s, self.frame_s);
        let led = paths.iter().map(|path| BodyMotion { drive: BodyDrive::Led, path });
        let free = free.iter().map(|_| BodyMotion { drive: BodyDrive::Free, path: &[] });
        let motions: Vec<_> = self.tools.iter().map(ToolLane::motion).chain(led).chain(free).collect();
        self.backend.submit(&FrameInput { duration: self.frame_s, bodies: &motions });
        let output = loop {
            match self.backend.poll() {
                Some(output) => break output,
                None => std::thread::yield_now(),
            }
        };
        let now = self.bodies.buffer();
        let mut sound = true;
        for (to, (state, load)) in now.iter_mut().zip(output.bodies.iter().zip(&output.loads)) {
            let finite = load.force().is_finite() && load.torque.is_finite();
            sound &= finite;
            *to = BodyReport { state: *state, load: if finite { *load } else { BodyLoad::default() } };
        }
        self.newest = report(&self.newest, output, now.first());
        self.flags.raise(FaultSet::FLUID_FAULT.when(!sound).bits());
        self.answer(frame);
        self.bodies.publish();
        self.report.write(self.newest);
        self.shared.answer_snapshot(&mut *self.backend);
    }

    /// Makes the local models of a frame that was stepped.
    fn answer(&mut self, frame: FrameTime) {
        for (k, (lane, config)) in self.tools.iter_mut().zip(&self.config.world.bodies).enumerate() {
            let body = self.bodies.buffer()[k];
            let around = lane.looks(config).map(|reach| {
                self.backend.surroundings(body.state.position, reach, &mut self.around);
                neighbourhood(&self.around, &self.config.settings)
            });
            let sound = lane.end_frame(config, body, around, frame);
            self.flags.raise(FaultSet::FLUID_FAULT.when(!sound).bits());
        }
    }

    /// Hands the computed frame's models to the servo, at `now_s` on its clock.
    pub fn publish(&mut self, now_s: f64) {
        self.tools.iter_mut().for_each(|lane| lane.publish(now_s));
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
        let Some((config, buoyancy)) = self.shared.newer_than(&mut self.seen) else { return };
        for (lane, scale) in self.tools.iter_mut().zip(buoyancy) {
            lane.buoyancy_scale = scale;
        }
        // Main has checked them; a backend that still refuses keeps its old ones and says so.
        match self.backend.configure(&config) {
            Ok(()) => self.config = config,
            Err(_) => self.newest.degraded += 1,
        }
    }
}

fn neighbourhood<'a>(around: &'a Surroundings, fluid: &FluidSettings) -> Neighbourhood<'a> {
    Neighbourhood {
        density: fluid.rest_density,
        viscosity: fluid.viscosity,
        gravity: fluid.gravity,
        origin: around.origin,
        spacing: around.spacing,
        side: Surroundings::SIDE,
        nodes: around.nodes(),
    }
}

fn report(last: &FluidReport, output: &FrameOutput, tool: Option<&BodyReport>) -> FluidReport {
    let load = tool.map_or(BodyLoad::default(), |tool| tool.load);
    FluidReport {
        frame: last.frame + 1,
        time_s: output.time,
        particles: output.particles,
        substeps: output.substeps,
        total_substeps: last.total_substeps + output.substeps as u64,
        max_speed: output.max_speed,
        load: Wrench { force: load.force(), torque: load.torque },
        degraded: last.degraded + u64::from(output.degraded),
    }
}
