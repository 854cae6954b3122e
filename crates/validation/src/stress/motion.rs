//! How a tool moves that nobody reckons with: it rests, glides, spins, shakes and is elsewhere at once.

use super::dice::Dice;
use glam::{DQuat, DVec3};
use hapflow_fluid::{Aabb, BodySample};

/// Fastest hand, m/s, at any place of the tool's surface.
const FASTEST: f64 = 5.0;
/// Ways to and fro in a frame.
const SHAKES: usize = 6;

/// A body on its way.
#[derive(Clone, Debug)]
pub(super) struct Mover {
    state: BodySample,
    /// Radius of the ball that holds it, m.
    radius: f64,
}

/// What a body did in a frame.
#[derive(Clone, Debug)]
pub(super) struct Moved {
    pub path: Vec<BodySample>,
    /// Highest speed of its surface, m/s.
    pub speed: f64,
    pub jumped: bool,
}

impl Mover {
    pub fn new(position: DVec3, radius: f64) -> Self {
        Self { state: BodySample::at(position), radius }
    }

    /// The next `duration` seconds, in or near `room`.
    pub fn next(&mut self, duration: f64, room: &Aabb, dice: &mut Dice) -> Moved {
        let target = dice.place(room.min, room.max);
        match dice.whole(0, 5) {
            0 => self.follow(&[self.state.position], DVec3::ZERO, duration),
            1 => {
                let turn = DQuat::from_axis_angle(dice.direction(), dice.within(0.0, 3.0));
                self.state = BodySample { orientation: turn, ..BodySample::at(target) };
                Moved { jumped: true, ..self.follow(&[target], DVec3::ZERO, duration) }
            }
            2 => self.follow(&[self.state.position], self.spin(1.0, dice), duration),
            3 => {
                let (from, reach) =
                    (self.state.position, dice.scale(0.01, FASTEST) * duration / SHAKES as f64);
                let there = from + (target - from).clamp_length_max(reach);
                let stops: Vec<_> = (0..SHAKES).map(|k| if k % 2 == 0 { there } else { from }).collect();
                self.follow(&stops, DVec3::ZERO, duration)
            }
            _ => {
                let (from, reach) = (self.state.position, dice.scale(0.01, 0.7 * FASTEST) * duration);
                let spin = if dice.chance(0.5) { self.spin(0.3, dice) } else { DVec3::ZERO };
                self.follow(&[from + (target - from).clamp_length_max(reach)], spin, duration)
            }
        }
    }

    /// A spin whose surface has up to `share` of the highest speed, rad/s.
    fn spin(&self, share: f64, dice: &mut Dice) -> DVec3 {
        dice.direction() * dice.scale(0.01, FASTEST) * share / self.radius
    }

    /// From stop to stop, each in as long, while it turns at `spin` (rad/s).
    fn follow(&mut self, stops: &[DVec3], spin: DVec3, duration: f64) -> Moved {
        let each = duration / stops.len() as f64;
        let mut path = vec![BodySample { time: 0.0, ..self.state }];
        for (k, &stop) in stops.iter().enumerate() {
            let turn = DQuat::from_scaled_axis(spin * each);
            self.state = BodySample {
                time: (k + 1) as f64 * each,
                position: stop,
                orientation: (turn * self.state.orientation).normalize(),
                velocity: (stop - self.state.position) / each,
                angular_velocity: spin,
            };
            path.push(self.state);
        }
        let surface = |s: &BodySample| s.velocity.length() + s.angular_velocity.length() * self.radius;
        let speed = path.iter().map(surface).fold(0.0, f64::max);
        Moved { path, speed, jumped: false }
    }
}
