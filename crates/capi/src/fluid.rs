//! The [fluid] functions: frames, and the particles after the newest.

use crate::caller::{Buffer, Out};
use crate::code::{Code, Outcome};
use crate::fence::fence;
use crate::handle::Handle;
use crate::hooks;
use crate::table::LIBRARY;
use crate::tool_state::check_time;
use hapflow_engine::{Control, FluidUnit};
use hapflow_fluid::ParticleView;
use hapflow_haptics::FaultSet;
use hapflow_realtime::Faultable;

/// Most fluid time that one call makes up for, s: a host that gives the time of another clock is told so, instead
/// of waiting for days.
const MOST_BEHIND_S: f64 = 10.0;
/// A frame is due this much before its end, s: sums of ticks do not meet it exactly.
const SLACK_S: f64 = 1e-9;

/// The fluid's part of a session.
pub struct FluidSide {
    control: Control,
    broken: bool,
    /// None: the session's own thread has it.
    hosted: Option<HostedFluid>,
}

/// A fluid that the host steps.
struct HostedFluid {
    unit: FluidUnit,
    fluid_hz: f64,
    /// End of the newest frame on the servo's clock, s.
    end_s: f64,
    /// Frames of the regular grid that lie before `end_s`.
    passed: u64,
    view: ParticleView,
    /// Whether `view` shows the newest frame.
    viewed: bool,
}

impl Faultable for FluidSide {
    fn fault(&mut self) {
        self.broken = true;
        self.control.raise(FaultSet::PANIC | FaultSet::FLUID_FAULT);
    }
}

impl FluidSide {
    pub fn new(unit: Option<FluidUnit>, control: Control, fluid_hz: f64) -> Self {
        let hosted = unit.map(|unit| HostedFluid {
            unit,
            fluid_hz,
            end_s: 0.0,
            passed: 0,
            view: ParticleView::default(),
            viewed: false,
        });
        Self { control, broken: false, hosted }
    }

    /// The fluid, if the host may step it.
    fn hosted(&mut self) -> Result<&mut HostedFluid, Code> {
        // A backend that was left half way through a frame might wait for itself for ever.
        if self.broken {
            return Err(Code::ERROR_FAULTED);
        }
        self.hosted.as_mut().ok_or(Code::ERROR_DRIVE)
    }
}

impl HostedFluid {
    fn step(&mut self, end_s: f64) -> Outcome {
        check_time(end_s)?;
        if end_s <= self.end_s {
            return Err(Code::ERROR_TIME);
        }
        self.frame(end_s);
        self.passed = ((end_s + SLACK_S) * self.fluid_hz).floor() as u64;
        Ok(Code::OK)
    }

    fn advance(&mut self, time_s: f64) -> Outcome {
        check_time(time_s)?;
        if time_s - self.end_s > MOST_BEHIND_S {
            return Err(Code::ERROR_TIME);
        }
        while self.next_end_s() <= time_s + SLACK_S {
            self.frame(self.next_end_s());
            self.passed += 1;
        }
        Ok(Code::OK)
    }

    /// Divided, not summed up: the frames end where every other run of the scene ends them.
    fn next_end_s(&self) -> f64 {
        (self.passed + 1) as f64 / self.fluid_hz
    }

    /// The last frame's model goes out as this one begins to be computed: no free look ahead.
    fn frame(&mut self, end_s: f64) {
        self.unit.publish(end_s);
        self.unit.compute(end_s);
        self.end_s = end_s;
        self.viewed = false;
    }

    fn positions(&mut self) -> &[[f32; 3]] {
        if !self.viewed {
            self.unit.snapshot(&mut self.view);
            self.viewed = true;
        }
        &self.view.positions
    }
}

fn with_fluid(session: Handle, body: impl FnOnce(&mut HostedFluid) -> Outcome) -> Code {
    fence(|| {
        let mut side = LIBRARY.fluid(session)?;
        let fluid = side.hosted()?;
        hooks::panic_if_asked();
        body(fluid)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_fluid_advance(session: Handle, time_s: f64) -> Code {
    with_fluid(session, |fluid| fluid.advance(time_s))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_fluid_step(session: Handle, end_s: f64) -> Code {
    with_fluid(session, |fluid| fluid.step(end_s))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_fluid_particles(
    session: Handle,
    positions: Buffer<[f32; 3]>,
    capacity: usize,
    count: Out<usize>,
) -> Code {
    with_fluid(session, |fluid| positions.enumerate(capacity, count, fluid.positions()))
}
