//! The energy that a coupling makes by itself, and its limit.

use glam::DVec3;

/// Energy that the coupling may have given beyond what it took since its lowest, J.
const BUDGET_J: f64 = 3e-4;
/// Time in which what was given is forgotten, s. The newest model is ahead of what is right where its law is not exact, so
/// that a right force gives or takes a little all the time.
const FORGET_S: f64 = 0.7;
/// Share of the budget from which on the controller acts.
const ACTS_FROM: f64 = 0.5;
/// Share of what the device says of the tool's place in where it is taken to be; the rest is its velocity's. On the steps of an
/// encoder a force that changes by newtons from model to model would do another work than on the tool.
const TRUST: f64 = 0.1;
/// Faster than any hand: such a step is a jump and does no work, m/s.
const JUMP_SPEED: f64 = 20.0;

/// Observer and controller of a coupling's own force: what it renders beyond the newest model. A jet or a swirl may do work on
/// the hand; what a coupling adds, to go from one model to the next without a step, may not.
///
/// The observer sums ∫ F_own · dx and knows its rise since its lowest (after Hannaford & Ryu 2002,
/// doi:10.1109/70.988969, on the coupling alone). The controller takes from the part of the force that pushes along
/// the motion a share that grows with the rise, so that this hardly passes 0.3 mJ (and as much again each 0.7 s, for it
/// is forgotten at that rate), and nothing while the force brakes. What passes it none the less, for the way turns within the
/// tick, it answers by less force in all directions.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Passivity {
    /// Where the device said that the tool was at the last tick, and when, s.
    last: Option<(DVec3, f64)>,
    /// Where it is taken to have been, m.
    place: DVec3,
    /// The own force since then, N.
    force: DVec3,
    rise_j: f64,
}

impl Passivity {
    /// The own force since the last tick, N.
    pub fn force(&self) -> DVec3 {
        self.force
    }

    /// Energy given beyond what was taken since the lowest, J.
    pub fn rise_j(&self) -> f64 {
        self.rise_j
    }

    /// What of the wanted own `force` (N) the tool may feel, which is at `place` (m) at `time_s` with `velocity` (m/s).
    pub fn admit(&mut self, force: DVec3, place: DVec3, velocity: DVec3, time_s: f64) -> DVec3 {
        let dt = self.observe(place, velocity, time_s);
        self.force = if force.dot(velocity) < 0.0 { force } else { self.hold_back(force, velocity, dt) };
        self.force
    }

    /// What is left of a `force` that does not brake, in a tick of `dt` seconds.
    fn hold_back(&self, force: DVec3, velocity: DVec3, dt: f64) -> DVec3 {
        let (power, square) = (force.dot(velocity), velocity.length_squared());
        let left = (1.0 - self.rise_j / BUDGET_J).max(0.0);
        // Nor more in this tick than is left.
        let keep = (left / (1.0 - ACTS_FROM)).min(left * BUDGET_J / (power * dt).max(1e-30)).min(1.0);
        let kept = force - velocity * (power / square.max(1e-30) * (1.0 - keep));
        // Within the tick the way turns to where the force pushes, the more the lighter the hand.
        kept * (2.0 - self.rise_j / BUDGET_J).clamp(0.0, 1.0)
    }

    /// Takes the work of the last tick, and returns its length, s.
    fn observe(&mut self, place: DVec3, velocity: DVec3, time_s: f64) -> f64 {
        let last = self.last.replace((place, time_s));
        let step = last.map(|(from, at_s)| (place - from, time_s - at_s));
        let Some((_, dt)) = step.filter(|(way, dt)| *dt > 0.0 && way.length() < JUMP_SPEED * dt) else {
            self.place = place;
            return 0.0;
        };
        let ahead = self.place + velocity * dt;
        let next = ahead + (place - ahead) * TRUST;
        let way = next - std::mem::replace(&mut self.place, next);
        self.rise_j = ((self.rise_j + self.force.dot(way)) * (1.0 - dt / FORGET_S).max(0.0)).max(0.0);
        dt
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever own force is wanted on whatever way, in no second more than three times the budget is given.
    #[test]
    fn it_gives_no_more_than_its_budget() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 40) as f64 / f64::from(1 << 24) - 0.5
        };
        let mut passivity = Passivity::default();
        let (mut place, mut given, mut lowest, mut most) = (DVec3::ZERO, 0.0_f64, 0.0_f64, 0.0_f64);
        let (mut velocity, mut wanted) = (DVec3::ZERO, DVec3::ZERO);
        for n in 0..100_000 {
            if n % 16 == 0 {
                wanted = DVec3::new(random(), random(), random());
            }
            velocity = velocity * 0.99 + DVec3::new(random(), random(), random()) * 0.01;
            let force = passivity.admit(wanted, place, velocity, f64::from(n) * 1e-3);
            place += velocity * 1e-3;
            if n % 1000 == 0 {
                (given, lowest) = (0.0, 0.0);
            }
            given += force.dot(velocity) * 1e-3;
            lowest = lowest.min(given);
            most = most.max(given - lowest);
        }
        assert!(most > 0.5 * BUDGET_J && most < 3.03 * BUDGET_J, "{most} J");
    }

    /// An encoder of 60 µm says where a slow tool is, and new models turn the force round each 4 ms: the work that counts is the
    /// tool's own.
    #[test]
    fn steps_of_an_encoder_are_no_work() {
        let mut passivity = Passivity::default();
        let (mut place, mut given, mut lowest, mut most) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        let velocity = DVec3::X * 0.01;
        for n in 0..500 {
            let wanted = if n / 4 % 2 == 0 { DVec3::X } else { DVec3::NEG_X } * 3.0;
            let seen = DVec3::X * (place / 60e-6).round() * 60e-6;
            let force = passivity.admit(wanted, seen, velocity, f64::from(n) * 1e-3);
            place += velocity.x * 1e-3;
            given += force.dot(velocity) * 1e-3;
            lowest = lowest.min(given);
            most = most.max(given - lowest);
        }
        assert!(most > 0.3 * BUDGET_J && most < 1.1 * BUDGET_J, "{most} J");
    }

    /// A light device turns to where a force across its motion pushes before that is known.
    #[test]
    fn a_force_across_the_motion_gives_little_too() {
        let mut passivity = Passivity::default();
        let (mut place, mut velocity) = (DVec3::ZERO, DVec3::X * 0.3);
        let mut given = 0.0;
        for n in 0..100 {
            let wanted = velocity.cross(DVec3::Z).normalize_or_zero() * 5.0;
            let force = passivity.admit(wanted, place, velocity, f64::from(n) * 1e-3);
            velocity += force / 0.1 * 1e-3;
            place += velocity * 1e-3;
            given += force.dot(velocity) * 1e-3;
        }
        assert!(given < 3.0 * BUDGET_J, "{given} J");
    }

    #[test]
    fn what_brakes_is_left_alone_and_so_is_what_it_can_afford() {
        let mut passivity = Passivity::default();
        let (force, velocity) = (DVec3::new(-1.0, 0.5, 0.0), DVec3::X * 0.3);
        for n in 0..100 {
            let t = f64::from(n) * 1e-3;
            assert_eq!(passivity.admit(force, velocity * t, velocity, t), force);
        }
        assert_eq!(passivity.rise_j(), 0.0);
        let push = DVec3::X * 1e-3;
        assert_eq!(Passivity::default().admit(push, DVec3::ZERO, push, 0.0), push);
    }

    #[test]
    fn a_jump_does_no_work() {
        let mut passivity = Passivity::default();
        passivity.admit(DVec3::X, DVec3::ZERO, DVec3::ZERO, 0.0);
        passivity.admit(DVec3::X, DVec3::X * 5.0, DVec3::ZERO, 1e-3);
        passivity.admit(DVec3::X, DVec3::X, DVec3::ZERO, f64::NAN);
        assert_eq!(passivity.rise_j(), 0.0);
    }
}
