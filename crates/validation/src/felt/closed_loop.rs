//! A hand, a device, a servo and a fluid in one loop, on the virtual clock.

use glam::DVec3;
use hapflow_devices::{AtEnd, HapticDevice, SimulatedHand, TargetScript};
use hapflow_engine::{
    FluidUnit, Scene, SceneError, ServoUnit, Session, SessionOptions, VirtualPace, run::TICK_S,
};
use hapflow_haptics::{GatedWrench, ToolState};

/// A session whose device is a simulated hand, and whose halves are driven from here.
pub(crate) struct ClosedLoop {
    pub session: Session,
    pub servo: ServoUnit,
    pub fluid: FluidUnit,
    pub hand: SimulatedHand,
}

impl ClosedLoop {
    /// That of `scene`, with its hand and script.
    pub fn open(scene: &Scene, options: SessionOptions) -> Result<Self, SceneError> {
        let mut session = Session::open(scene, options)?;
        let taken = || SceneError::Refused("the session's halves are taken".into());
        let servo = session.take_servo().ok_or_else(taken)?;
        let fluid = session.take_fluid().ok_or_else(taken)?;
        let script = TargetScript::new(scene.tool.position, &scene.script, AtEnd::Hold)?;
        let hand = SimulatedHand::new(scene.hand, script)?;
        Ok(Self { session, servo, fluid, hand })
    }

    /// One tick of hand and servo, `dt_s` seconds after the last; `seen` makes of the device's state what the servo gets.
    pub fn tick(
        &mut self,
        time_s: f64,
        dt_s: f64,
        seen: impl FnOnce(ToolState) -> ToolState,
    ) -> Result<GatedWrench, SceneError> {
        let state = seen(self.hand.read(time_s)?);
        let wrench = self.servo.tick(&state, time_s, dt_s);
        self.hand.write(wrench, dt_s)?;
        Ok(wrench)
    }
}

/// Every tick of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trace {
    /// Where the device truly was, m; one more than ticks.
    pub path: Vec<DVec3>,
    /// What left for the hand, N.
    pub sent: Vec<DVec3>,
    /// Whether a new model came.
    pub fresh: Vec<bool>,
}

/// Runs `scene`, whose device is a simulated hand.
pub(crate) fn run(scene: &Scene, threads: usize) -> Result<Trace, SceneError> {
    let mut felt = ClosedLoop::open(scene, SessionOptions { threads, ..SessionOptions::hosted() })?;
    let mut pace = VirtualPace::new(scene);
    let mut trace = Trace::default();
    for n in 0..=(scene.run.duration / TICK_S).round() as u64 {
        let time_s = n as f64 * TICK_S;
        trace.fresh.push(pace.advance(&mut felt.fluid, time_s));
        trace.sent.push(felt.tick(time_s, TICK_S, |state| state)?.force());
        trace.path.push(felt.hand.truth().position);
    }
    trace.sent.pop();
    trace.fresh.pop();
    Ok(trace)
}
