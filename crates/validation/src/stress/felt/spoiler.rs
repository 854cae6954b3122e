//! A fluid whose frames can be spoilt from outside.

use super::mishap::Spoilt;
use glam::DVec3;
use hapflow_fluid::{
    FluidBackend, FluidConfig, FluidError, FrameInput, FrameOutput, ParticleView, Surroundings,
};
use std::sync::{Arc, Mutex, PoisonError};

/// Who spoils the next frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Spoiler(Arc<Mutex<Option<Spoilt>>>);

impl Spoiler {
    /// The next frame comes out like this.
    pub fn spoil(&self, how: Spoilt) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(how);
    }

    /// `fluid`, whose frames may be spoilt.
    pub fn wrap(&self, fluid: Box<dyn FluidBackend>) -> Box<dyn FluidBackend> {
        Box::new(Spoilable { fluid, spoiler: self.clone(), now: None, output: FrameOutput::default() })
    }

    fn take(&self) -> Option<Spoilt> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

struct Spoilable {
    fluid: Box<dyn FluidBackend>,
    spoiler: Spoiler,
    /// How the newest frame is spoilt.
    now: Option<Spoilt>,
    output: FrameOutput,
}

impl FluidBackend for Spoilable {
    fn name(&self) -> &'static str {
        self.fluid.name()
    }

    fn configure(&mut self, config: &FluidConfig) -> Result<(), FluidError> {
        self.fluid.configure(config)
    }

    fn submit(&mut self, frame: &FrameInput<'_>) {
        self.fluid.submit(frame);
    }

    fn poll(&mut self) -> Option<&FrameOutput> {
        self.output.clone_from(self.fluid.poll()?);
        self.now = self.spoiler.take();
        let force = match self.now {
            Some(Spoilt::Nan) => DVec3::NAN,
            Some(Spoilt::Infinite) => DVec3::NEG_INFINITY,
            Some(Spoilt::Blow(size)) => DVec3::new(0.6, -0.8, 0.0) * size,
            Some(Spoilt::Nowhere) | None => return Some(&self.output),
        };
        for load in &mut self.output.loads {
            load.pressure_force += force;
            load.torque += force * 0.01;
        }
        Some(&self.output)
    }

    fn snapshot(&mut self, view: &mut ParticleView) {
        self.fluid.snapshot(view);
    }

    fn surroundings(&mut self, around: DVec3, reach: f64, out: &mut Surroundings) {
        self.fluid.surroundings(around, reach, out);
        if self.now == Some(Spoilt::Nowhere) {
            out.origin = DVec3::NAN;
        }
    }
}
