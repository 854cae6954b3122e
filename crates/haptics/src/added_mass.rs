//! The fluid that goes along with a tool.

use crate::ToolState;
use glam::DVec3;

/// Frequency at which the mass hangs on the tool, rad/s: 8 Hz, above what a hand does on purpose.
const OMEGA: f64 = 50.0;
/// Longest time between ticks that still belong together, s.
const MAX_GAP_S: f64 = 0.05;

/// A proxy that hangs on the tool by a spring and a damper (critically damped) and carries the added mass.
///
/// Fed through a late fluid, the inertia of the water that a tool carries makes a light device unstable as soon as that
/// weighs about as much as hand and device. Here it is the proxy's, integrated implicitly, so it stays passive at any mass.
/// Since spring and damper are in proportion to the mass, the proxy's motion does not depend on it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct AddedMass {
    place: DVec3,
    velocity: DVec3,
    time_s: Option<f64>,
}

impl AddedMass {
    /// The proxy's acceleration (m/s²) after it has followed `tool` to `time_s`; minus that, times the mass, is felt.
    pub fn follow(&mut self, tool: &ToolState, time_s: f64) -> DVec3 {
        let dt = time_s - self.time_s.unwrap_or(f64::NEG_INFINITY);
        self.time_s = Some(time_s);
        if !(dt > 0.0 && dt < MAX_GAP_S) {
            (self.place, self.velocity) = (tool.position, tool.velocity);
            return DVec3::ZERO;
        }
        let pull = OMEGA * OMEGA * (tool.position - self.place - dt * self.velocity);
        let drag = 2.0 * OMEGA * (tool.velocity - self.velocity);
        let acceleration = (pull + drag) / (1.0 + dt * OMEGA * (2.0 + dt * OMEGA));
        self.velocity += acceleration * dt;
        self.place += self.velocity * dt;
        acceleration
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn tool(place: f64, velocity: f64) -> ToolState {
        ToolState { velocity: DVec3::X * velocity, ..ToolState::at(DVec3::X * place) }
    }

    #[test]
    fn a_hands_swing_is_followed_and_a_buzz_is_not() {
        for (hz, least, most) in [(1.0, 0.95, 1.05), (50.0, 0.0, 0.45)] {
            let (mut proxy, w) = (AddedMass::default(), TAU * hz);
            let mut peak = 0.0_f64;
            for n in 0..3000 {
                let t = f64::from(n) * 1e-3;
                let a = proxy.follow(&tool((w * t).sin() / (w * w), (w * t).cos() / w), t);
                peak = if n > 2000 { peak.max(a.length()) } else { 0.0 };
            }
            assert!((least..most).contains(&peak), "{hz} Hz: {peak}");
        }
    }

    /// Whatever the tool does, the work on it is what the proxy had.
    #[test]
    fn it_makes_no_energy() {
        let mut proxy = AddedMass::default();
        let (mut work, mut last, mut seed) = (0.0, 0.0, 7_u64);
        let mut place = 0.0;
        for n in 0..20_000 {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let velocity = (seed >> 40) as f64 / f64::from(1 << 24) - 0.5;
            place += 0.5 * (last + velocity) * 1e-3;
            let a = proxy.follow(&tool(place, velocity), f64::from(n) * 1e-3);
            work += -a.x * velocity * 1e-3;
            last = velocity;
            assert!(work < 1e-6, "{n}: {work} J/kg");
        }
    }

    #[test]
    fn a_jump_or_a_pause_begins_anew() {
        let mut proxy = AddedMass::default();
        assert_eq!(proxy.follow(&tool(0.3, 1.0), 5.0), DVec3::ZERO);
        assert_eq!(proxy.follow(&tool(0.9, -1.0), 6.0), DVec3::ZERO);
        assert_eq!(proxy.follow(&tool(0.9, -1.0), f64::NAN), DVec3::ZERO);
    }
}
