//! Stepping: a fluid that is run one sub-step at a time, so that each force is that of a step.

use crate::{Measure, Setup, ValidationError};
use glam::DVec3;
use hapflow_fluid::{
    BodyDrive, BodyMotion, BodySample, CpuBackend, FluidBackend, FluidConfig, FrameInput, FrameOutput,
    ParticleView, step_limits,
};

/// What came of a case at one spacing.
#[derive(Clone, Debug)]
pub struct Report {
    /// What was measured.
    pub measures: Vec<Measure>,
    /// Particles at the end.
    pub particles: usize,
    /// Simulated time, settling included, s.
    pub simulated_s: f64,
    /// Name of the backend.
    pub backend: &'static str,
    /// What the fluid was made of.
    pub config: FluidConfig,
}

/// A fluid under way.
pub(crate) struct Run {
    fluid: CpuBackend,
    config: FluidConfig,
    view: ParticleView,
    particles: usize,
    steps: usize,
    /// Length of a step, s.
    dt: f64,
    /// Bodies at the end of the last step.
    bodies: Vec<BodySample>,
}

impl Run {
    /// The fluid of `config` as a scene starts it.
    pub fn start(setup: &Setup<'_>, config: FluidConfig) -> Result<Self, ValidationError> {
        setup.check(&config)?;
        Self::new(setup, config.clone(), config)
    }

    /// The fluid of `config` with no pressure anywhere, as if gravity had just begun.
    pub fn start_without_pressure(setup: &Setup<'_>, config: FluidConfig) -> Result<Self, ValidationError> {
        setup.check(&config)?;
        let mut weightless = config.clone();
        weightless.settings.gravity = DVec3::ZERO;
        Self::new(setup, weightless, config)
    }

    /// Fills the pools by `filling` and goes on by `config`.
    fn new(setup: &Setup<'_>, filling: FluidConfig, config: FluidConfig) -> Result<Self, ValidationError> {
        let refused = |cause| ValidationError::Fluid { case: setup.case.name, dx: setup.dx, cause };
        let mut fluid = CpuBackend::new(&filling).map_err(refused)?;
        fluid.configure(&config).map_err(refused)?;
        let limit = step_limits(&config, config.reference_speed()).shortest();
        // Whole steps in a millisecond, where it has room for more than one.
        let dt = if limit < 1e-3 { 1e-3 / (1e-3 / limit).ceil() } else { limit };
        let bodies = config.world.bodies.iter().map(|b| BodySample::at(b.position)).collect();
        let view = ParticleView::default();
        Ok(Self { fluid, config, view, particles: 0, steps: 0, dt, bodies })
    }

    /// Length of a step, s.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Steps in a millisecond, or one if they are longer.
    pub fn steps_per_ms(&self) -> usize {
        (1e-3 / self.dt).round().max(1.0) as usize
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.dt()
    }

    /// What the fluid is made of.
    pub fn config(&self) -> &FluidConfig {
        &self.config
    }

    /// Gives the fluid the velocities of `flow`.
    pub fn set_flow(&mut self, flow: impl Fn(DVec3) -> DVec3) {
        self.fluid.set_flow(flow);
    }

    /// One step, at whose end the bodies are as `bodies` says; none leaves them where they are.
    pub fn step(&mut self, bodies: Option<Vec<BodySample>>) -> FrameOutput {
        self.drive(bodies, BodyDrive::Led)
    }

    /// One step in which the first body goes where fluid and gravity take it.
    pub fn step_free(&mut self) -> FrameOutput {
        let output = self.drive(None, BodyDrive::Free);
        self.bodies.clone_from(&output.bodies);
        output
    }

    /// One step in which the first body moves by `drive` and the others are led.
    fn drive(&mut self, bodies: Option<Vec<BodySample>>, drive: BodyDrive) -> FrameOutput {
        let (before, after) = (self.time(), self.time() + self.dt());
        let next = bodies.unwrap_or_else(|| self.bodies.clone());
        let at = |time: f64, b: &BodySample| BodySample { time, ..*b };
        let paths: Vec<_> =
            self.bodies.iter().zip(&next).map(|(a, b)| [at(before, a), at(after, b)]).collect();
        let drives = std::iter::once(drive).chain(std::iter::repeat(BodyDrive::Led));
        let motions: Vec<_> =
            paths.iter().zip(drives).map(|(path, drive)| BodyMotion { drive, path }).collect();
        self.fluid.submit(&FrameInput { duration: self.dt(), bodies: &motions });
        self.steps += 1;
        self.bodies = next;
        let output = self.fluid.poll().cloned().unwrap_or_default();
        self.particles = output.particles;
        output
    }

    /// Steps for `seconds` with the only body at `motion` of the time; what `see` makes of each step, by time.
    pub fn record(
        &mut self,
        seconds: f64,
        motion: impl Fn(f64) -> BodySample,
        see: impl Fn(&FrameOutput) -> f64,
    ) -> Vec<[f64; 2]> {
        let steps = (seconds / self.dt()).round() as usize;
        let step = |_| {
            let body = motion(self.time() + self.dt());
            let output = self.step(Some(vec![body]));
            [self.time(), see(&output)]
        };
        (0..steps).map(step).collect()
    }

    /// The particles as they are.
    pub fn particles(&mut self) -> &ParticleView {
        self.fluid.snapshot(&mut self.view);
        &self.view
    }

    /// Ends the run.
    pub fn report(self, measures: Vec<Measure>) -> Report {
        let (particles, simulated_s) = (self.particles, self.time());
        let backend = self.fluid.name();
        Report { measures, particles, simulated_s, backend, config: self.config }
    }
}

/// Rows of a snapshot in f64.
pub(crate) fn vectors(rows: &[[f32; 3]]) -> impl Iterator<Item = DVec3> {
    rows.iter().map(|r| glam::Vec3::from(*r).as_dvec3())
}
