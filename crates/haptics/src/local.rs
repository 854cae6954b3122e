//! The coupling `local`, on the fluid's side.

use crate::immersion::Immersion;
use crate::impact::Stream;
use crate::{Answer, BodyState, Coupling, Drive, FrameEnd, Law, LawNode, Neighbourhood, ToolState, Wrench};
use glam::DVec3;

/// How far round the tool it looks, in its radii.
const REACH: f64 = 3.0;
/// Way before the tool within which the stream is disturbed by the tool itself, in its radii.
const NEAR: f64 = 1.0;
/// Distance of the law's places, at least as a share of the radius, and for each second of a frame, m.
const SPACING: [f64; 2] = [0.2, 0.3];
/// Time over which the law's size is fitted to the fluid's force, s.
const FIT_S: f64 = 0.3;
/// Acceleration below which the added mass is hardly measured, m/s².
const QUIET: f64 = 0.3;
/// Largest factor on the law, and on the added mass.
const MOST: f64 = 3.0;

/// See [`CouplingKind::Local`](crate::CouplingKind::Local).
///
/// The fluid's load on the led tool is split into a law, which says how the force changes with the tool's place and velocity,
/// and the rest: F = (F̄ − L̄) + L(x, v), with means over the frame's path. The law is the lift, and β times the impact of the
/// stream or the drag of the fluid that the tool stands in. β is the ratio of the force and that in the last time, times how
/// well they go together. What the fluid answers to the tool's acceleration is taken off, and left to the servo.
#[derive(Debug, Default)]
pub(crate) struct Local {
    stream: Stream,
    fit: Fit,
    /// How far the tool stands in the fluid, 0..1.
    stands: f64,
}

impl Coupling for Local {
    fn leads(&self) -> bool {
        true
    }

    fn bend(&self) -> f64 {
        1.0 - self.stands
    }

    fn looks(&self, radius: f64) -> Option<f64> {
        Some(REACH * radius)
    }

    fn begin_frame(&mut self, _: &BodyState, _: &ToolState, _: f64) -> Drive {
        Drive::Led
    }

    fn end_frame(&mut self, frame: &FrameEnd<'_>) -> Answer {
        let Some(around) = &frame.around else { return Answer { wrench: frame.load, ..Answer::default() } };
        let pool = Immersion::look(around, frame.body.position, frame.radius);
        self.stands = pool.share();
        let (moving, lift) = self.laws(frame, around, &pool);
        let part = Part {
            force: frame.load.force - mean_force(&lift, frame.path),
            law: mean_force(&moving, frame.path),
            acceleration: acceleration(frame),
            added_mass: pool.added_mass(frame.volume, frame.radius, frame.body.position),
        };
        let (factor, added_mass) = self.fit.take(&part, frame.frame_s);
        let law = moving.scaled(factor).plus(&lift);
        let rest = frame.load.force + part.acceleration * added_mass - mean_force(&law, frame.path);
        Answer { wrench: Wrench { force: rest, ..frame.load }, law, added_mass }
    }
}

impl Local {
    /// The law of what moves against the tool, and that of the lift, of the same places.
    fn laws(&mut self, frame: &FrameEnd<'_>, around: &Neighbourhood<'_>, pool: &Immersion) -> (Law, Law) {
        let (at, radius, stands) = (frame.felt_at, frame.radius, self.stands);
        self.stream.take(around.parcels(), NEAR * radius, (REACH - 1.0 - NEAR) * radius);
        let farthest = frame.path.iter().map(|t| t.position.distance(at.position)).fold(0.0, f64::max);
        let spacing = (SPACING[0] * radius).max(SPACING[1] * frame.frame_s).max(farthest);
        let tabulate =
            |force: &dyn Fn(DVec3) -> LawNode| Law::tabulate(at.position, at.velocity, spacing, force);
        let moving = |place| {
            let struck =
                if stands < 1.0 { self.stream.force(radius, place, at.velocity) } else { LawNode::ZERO };
            let drag = if stands > 0.0 { pool.drag(radius, place, at.velocity) } else { LawNode::ZERO };
            struck.scaled(1.0 - stands).plus(&drag.scaled(stands))
        };
        let lift =
            |place| LawNode { force: pool.lift(frame.volume, radius, place).as_vec3(), ..LawNode::ZERO };
        (tabulate(&moving), tabulate(&lift))
    }
}

/// What a frame's force is to be made of: means over its path.
struct Part {
    /// The force but for the lift, N.
    force: DVec3,
    /// The law of what moves, N.
    law: DVec3,
    /// Acceleration of the tool, m/s².
    acceleration: DVec3,
    /// The added mass in theory, kg.
    added_mass: f64,
}

impl Part {
    fn is_finite(&self) -> bool {
        let vectors = [self.force, self.law, self.acceleration];
        vectors.iter().all(|v| v.is_finite()) && self.added_mass.is_finite()
    }
}

/// F = β L − m a: β and m for which the fluid's force was the law's and the added mass's in the last time, by least squares.
/// m is near its theory while there is little acceleration; a viscous fluid answers with more.
#[derive(Debug, Default)]
struct Fit {
    force_force: f64,
    force_law: f64,
    law_law: f64,
    force_acceleration: f64,
    law_acceleration: f64,
    acceleration_acceleration: f64,
}

impl Fit {
    /// Takes a frame and gives β, times the share of the force that both explain, and m. What is no number is not kept: it would
    /// stay for ever.
    fn take(&mut self, part: &Part, frame_s: f64) -> (f64, f64) {
        if !part.is_finite() {
            return (0.0, 0.0);
        }
        let share = 1.0 - (-frame_s / FIT_S).exp();
        // What is looked for is by how much the mass is more than in theory.
        let (f, l, a) = (part.force + part.acceleration * part.added_mass, part.law, part.acceleration);
        for (mean, new) in [
            (&mut self.force_force, f.length_squared()),
            (&mut self.force_law, f.dot(l)),
            (&mut self.law_law, l.length_squared()),
            (&mut self.force_acceleration, f.dot(a)),
            (&mut self.law_acceleration, l.dot(a)),
            (&mut self.acceleration_acceleration, a.length_squared()),
        ] {
            *mean += (new - *mean) * share;
        }
        let more = self.more_mass().clamp(-part.added_mass, (MOST - 1.0) * part.added_mass);
        let driven = self.force_law + more * self.law_acceleration;
        if self.law_law * self.force_force <= 1e-24 {
            return (0.0, part.added_mass + more);
        }
        let explained = driven * driven / (self.law_law * self.force_force);
        ((driven / self.law_law).clamp(0.0, MOST) * explained.min(1.0), part.added_mass + more)
    }

    /// By how much the added mass is more than in theory.
    fn more_mass(&self) -> f64 {
        let (ll, aa) = (self.law_law, self.acceleration_acceleration + QUIET * QUIET);
        let (fl, fa, la) = (self.force_law, self.force_acceleration, self.law_acceleration);
        let determinant = ll * aa - la * la;
        if determinant > 1e-24 { (fl * la - fa * ll) / determinant } else { 0.0 }
    }
}

/// Mean acceleration of the tool over the frame, m/s².
fn acceleration(frame: &FrameEnd<'_>) -> DVec3 {
    match frame.path {
        [first, .., last] => (last.velocity - first.velocity) / frame.frame_s,
        _ => DVec3::ZERO,
    }
}

/// Mean of a law over a path, N.
fn mean_force(law: &Law, path: &[ToolState]) -> DVec3 {
    path.iter().map(|tool| law.at(tool)).sum::<DVec3>() / path.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_of_no_numbers_is_forgotten() {
        let part = |force: f64| Part {
            force: DVec3::Y * force,
            law: DVec3::Y,
            acceleration: DVec3::X,
            added_mass: 0.01,
        };
        let (mut spoilt, mut sound) = (Fit::default(), Fit::default());
        for force in [1.0, 2.0, f64::NAN, f64::INFINITY, 1.5] {
            let answer = spoilt.take(&part(force), 0.01);
            if force.is_finite() {
                assert_eq!(answer, sound.take(&part(force), 0.01));
            }
        }
        assert!(spoilt.take(&Part { added_mass: f64::NAN, ..part(1.0) }, 0.01).0 == 0.0);
    }
}
