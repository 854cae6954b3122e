//! A hand, a device, a servo and a fluid in one loop, on the virtual clock.

use glam::DVec3;
use hapflow_devices::{AtEnd, HapticDevice, SimulatedHand, TargetScript};
use hapflow_engine::{Scene, SceneError, Session, SessionOptions, VirtualPace, run::TICK_S};

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
    let options = SessionOptions { threads, ..SessionOptions::hosted() };
    let mut session = Session::open(scene, options)?;
    let taken = || SceneError::Refused("the session's halves are taken".into());
    let mut servo = session.take_servo().ok_or_else(taken)?;
    let mut fluid = session.take_fluid().ok_or_else(taken)?;
    let script = TargetScript::new(scene.tool.position, &scene.script, AtEnd::Hold)?;
    let mut hand = SimulatedHand::new(scene.hand, script)?;
    let mut pace = VirtualPace::new(scene);
    let mut trace = Trace::default();
    for n in 0..=(scene.run.duration / TICK_S).round() as u64 {
        let time_s = n as f64 * TICK_S;
        let fresh = pace.advance(&mut fluid, time_s);
        let state = hand.read(time_s)?;
        let wrench = servo.tick(&state, time_s, TICK_S);
        hand.write(wrench, TICK_S)?;
        trace.path.push(hand.truth().position);
        trace.sent.push(wrench.force());
        trace.fresh.push(fresh);
    }
    trace.sent.pop();
    trace.fresh.pop();
    Ok(trace)
}
