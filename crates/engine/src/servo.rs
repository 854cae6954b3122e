//! One servo tick. Thread: servo, one at a time; no lock, no allocation, no log, no system call.

use crate::control::CLEAR;
use crate::force_limit::ForceLimit;
use crate::touch::Touch;
use glam::DVec3;
use hapflow_haptics::{
    Clutch, FaultSet, Filter, GateSettings, GatedWrench, LocalModel, Mapping, ModelAge, Rendering,
    SafetyGate, ToolState, Wrench,
};
use hapflow_realtime::{HostClock, LatestReader, LatestWriter, RingProducer, SharedFlags};
use std::sync::Arc;

/// A tool state with its time, as the fluid gets it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathSample {
    pub time_s: f64,
    pub tool: ToolState,
}

/// Settings of the servo that may change while it runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ServoSettings {
    pub gate: GateSettings,
    pub force_scale: f64,
    /// Radius of the ball round the tool, m.
    pub reach: f64,
}

/// What came of the newest tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ServoReport {
    /// Number of the tick, from 1.
    pub tick: u64,
    /// Its time, s.
    pub time_s: f64,
    /// The tool, scene frame.
    pub tool: ToolState,
    /// Where the tool's body is in the fluid, m.
    pub body: DVec3,
    /// What the coupling gave, scene frame.
    pub raw: Wrench,
    /// What the filter made of it, scene frame.
    pub filtered: Wrench,
    /// What left the gate, scene frame.
    pub sent: Wrench,
    /// What went wrong at this tick.
    pub faults: FaultSet,
    /// Number of the newest fluid frame.
    pub frame: u64,
    /// Age of its data, s.
    pub age_s: f64,
    /// Force that coupling `local` itself adds to that of its newest model, N.
    pub own: DVec3,
    /// Energy that coupling `local` itself, not the fluid, has given beyond what it took since its lowest, J.
    pub own_energy_j: f64,
    /// Force that was taken off so that it gives no more, N.
    pub held_back_n: f64,
}

/// The servo's half of a session.
pub struct ServoUnit {
    pub(crate) mapping: Mapping,
    pub(crate) rendering: Rendering,
    /// What carries the weight of the device's grip, device frame.
    pub(crate) lift: Wrench,
    /// Where the scene has one.
    pub(crate) clutch: Option<Clutch>,
    pub(crate) filter: Filter,
    pub(crate) gate: SafetyGate,
    pub(crate) limit: ForceLimit,
    pub(crate) force_scale: f64,
    pub(crate) reach: f64,
    /// Where the solids are felt.
    pub(crate) touch: Option<Touch>,
    pub(crate) frame_s: f64,
    pub(crate) path: RingProducer<PathSample>,
    pub(crate) model: LatestReader<LocalModel>,
    pub(crate) settings: LatestReader<ServoSettings>,
    pub(crate) flags: SharedFlags,
    pub(crate) clear: SharedFlags,
    pub(crate) report: LatestWriter<ServoReport>,
    pub(crate) tape: Option<RingProducer<ServoReport>>,
    pub(crate) newest: ServoReport,
    pub(crate) last_device: ToolState,
    pub(crate) started_s: f64,
    /// The clock of an owned fluid under a host's servo: every tick moves it on.
    pub(crate) pace: Option<Arc<HostClock>>,
}

impl std::fmt::Debug for ServoUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ServoUnit").field("newest", &self.newest).finish_non_exhaustive()
    }
}

impl ServoUnit {
    /// One tick: the device is in `device` state (device frame) at `time_s`, `dt_s` after the last tick.
    /// Returns the wrench for the device, always finite and limited, zero on any fault.
    ///
    /// A state that is not finite raises a fault that latches. `dt_s` that is not positive and finite changes no
    /// force.
    pub fn tick(&mut self, device: &ToolState, time_s: f64, dt_s: f64) -> GatedWrench {
        self.take_settings();
        if self.newest.tick == 0 {
            self.started_s = time_s;
        }
        let faults = self.take_input(device, time_s);
        if let Some(clock) = &self.pace {
            // Negative and NaN become 0, which moves nothing.
            clock.set_ns((time_s * 1e9) as u64);
        }
        let (shown, free) =
            self.clutch.as_mut().map_or((self.last_device, false), |c| c.step(&self.last_device));
        let tool = self.mapping.to_scene(shown);
        let (in_fluid, pushed) = self.touch_solids(&tool, time_s, dt_s);
        let lost = self.path.push(PathSample { time_s, tool: in_fluid });
        let new_frame = self.model.update();
        let model = self.model.get();
        let raw = self.rendering.tick(model, new_frame, &tool, time_s, self.force_scale);
        let filtered = self.filter.step(raw, new_frame);
        // Solids are not filtered: they would feel late, and soft.
        let felt = filtered + Wrench::from_force(pushed);
        let felt = if free { Wrench::ZERO } else { felt };
        let wanted = self.mapping.to_device(felt) + self.mapping.rim_force(&self.last_device) + self.lift;
        let (age, body, frame) = (self.age(model, time_s), model.body, model.frame);
        let faults = faults | FaultSet::PATH_OVERFLOW.when(lost);
        let sent = self.gate.pass(wanted, &age, faults, dt_s);
        self.newest = ServoReport {
            tick: self.newest.tick + 1,
            time_s,
            tool,
            body,
            raw,
            filtered,
            sent: self.mapping.wrench_to_scene(sent.wrench()),
            faults: self.gate.faults(),
            frame,
            age_s: age.age_s,
            own: self.rendering.own_force(),
            own_energy_j: self.rendering.own_energy_j(),
            held_back_n: self.rendering.held_back_n(),
        };
        self.report.write(self.newest);
        if let Some(tape) = &mut self.tape {
            tape.push(self.newest);
        }
        sent
    }

    /// The newest tick.
    pub fn newest(&self) -> &ServoReport {
        &self.newest
    }

    /// The newest model that it has.
    pub fn model(&self) -> &LocalModel {
        self.model.get()
    }

    /// Raises a fault from outside the tick: a lost device, a panic.
    pub fn raise(&self, fault: FaultSet) {
        self.flags.raise(fault.bits());
    }

    fn take_settings(&mut self) {
        if self.settings.update() {
            let new = *self.settings.get();
            (self.force_scale, self.reach) = (new.force_scale, new.reach);
            // They were checked on main; if not, the old ones stay.
            let _ = self.gate.set_settings(new.gate);
        }
        self.limit.hold(&mut self.gate);
        if self.clear.load() != 0 {
            let raised = self.clear.clear(u32::MAX) & !CLEAR;
            self.gate.clear_faults(FaultSet::from_bits(raised));
            if let Some(touch) = &mut self.touch {
                touch.reset();
            }
        }
    }

    /// The tool as solids let it be, and how they push the hand; without any, or where they are not felt, as it is.
    fn touch_solids(&mut self, tool: &ToolState, time_s: f64, dt_s: f64) -> (ToolState, DVec3) {
        let Some(touch) = &mut self.touch else { return (*tool, DVec3::ZERO) };
        let touching = touch.tick(tool, self.reach, time_s, dt_s);
        let in_fluid = ToolState { position: touching.proxy, velocity: touching.velocity, ..*tool };
        (in_fluid, touching.force())
    }

    /// Keeps the last sound state: what is not finite never reaches the fluid.
    fn take_input(&mut self, device: &ToolState, time_s: f64) -> FaultSet {
        let sound = device.is_finite() && time_s.is_finite();
        if sound {
            self.last_device = *device;
        }
        FaultSet::from_bits(self.flags.load()) | FaultSet::NON_FINITE_INPUT.when(!sound)
    }

    fn age(&self, model: &LocalModel, time_s: f64) -> ModelAge {
        // Before the first model the wait counts from the first tick: a fluid that never comes is stale too.
        let since = if model.frame == 0 { self.started_s } else { model.published_s };
        ModelAge { age_s: time_s - since, frame_s: self.frame_s }
    }
}
