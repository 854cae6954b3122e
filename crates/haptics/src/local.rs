//! The coupling `local`, on the fluid's side.

use crate::immersion::Immersion;
use crate::impact::Stream;
use crate::{Answer, BodyState, Coupling, Drive, FrameEnd, Law, LawNode, Neighbourhood, ToolState, Wrench};
use glam::DVec3;
use std::collections::VecDeque;

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
/// Time over which frames are averaged before they are fitted, s: a fast fluid's frame is the mean over little time, and noisy.
const MEAN_S: f64 = 1.0 / 60.0;
/// Largest factor on the law, and on the added mass.
const MOST: f64 = 3.0;

/// See [`CouplingKind::Local`](crate::CouplingKind::Local).
///
/// The fluid's load on the led tool is split into a law, which says how the force changes with the tool's place and velocity,
/// and the rest: F = (F̄ − L̄) + L(x, v), with means over the frame's path. The law is the lift, and β times the impact of the
/// stream or the drag of the fluid that the tool stands in. β is the ratio of the force and that in the last time, times how
/// well they go together. What the fluid answers to the tool's acceleration is taken off, and left to the servo. The lift may be
/// given another size than the rest: what is not of the lift's law is not changed by that.
#[derive(Debug, Default)]
pub(crate) struct Local {
    stream: Stream,
    fit: Fit,
    /// How far the tool stands in the fluid, 0..1.
    stands: f64,
    /// The frames that are averaged, the newest last, and their way.
    past: VecDeque<Past>,
    path: Vec<ToolState>,
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

    fn late_s(&self, frame_s: f64) -> f64 {
        0.5 * (frames(frame_s) - 1) as f64 * frame_s
    }

    fn begin_frame(&mut self, _: &BodyState, _: &ToolState, _: f64) -> Drive {
        Drive::Led
    }

    fn end_frame(&mut self, frame: &FrameEnd<'_>) -> Answer {
        let Some(around) = &frame.around else { return Answer { wrench: frame.load, ..Answer::default() } };
        if !frame.load.is_finite() {
            return Answer { wrench: frame.load, ..Answer::default() };
        }
        let pool = Immersion::look(around, frame.body.position, frame.radius);
        self.stands = pool.share();
        let (load, acceleration) = self.remember(frame);
        let (moving, lift) = self.laws(frame, around, &pool);
        let lifted = mean_force(&lift, &self.path);
        let part = Part {
            force: load.force - lifted,
            law: mean_force(&moving, &self.path),
            acceleration,
            added_mass: pool.added_mass(frame.volume, frame.radius, frame.body.position),
        };
        // What is no number is not kept: it would stay for ever.
        if !part.is_finite() {
            return Answer { wrench: frame.load, ..Answer::default() };
        }
        let (factor, added_mass) = self.fit.take(&part, frame.frame_s);
        let law = moving.scaled(factor).plus(&lift.scaled(frame.buoyancy_scale));
        // Less the very law that is rendered, so that a tool at rest gets its load to the last bit.
        let rest = load.force + acceleration * added_mass - mean_force(&law, &self.path);
        let force = rest + lifted * (frame.buoyancy_scale - 1.0);
        Answer { wrench: Wrench { force, ..load }, law, added_mass }
    }
}

/// Frames of `frame_s` seconds that are averaged.
fn frames(frame_s: f64) -> usize {
    (MEAN_S / frame_s).round().max(1.0) as usize
}

impl Local {
    /// Takes a frame, and gives the mean load and acceleration of it and those before that are averaged with it; their way is then
    /// in `path`. The newest law is compared with the force on all of it, so that what changes in it from frame to frame by chance is
    /// taken off again.
    fn remember(&mut self, frame: &FrameEnd<'_>) -> (Wrench, DVec3) {
        self.past.push_back(Past {
            load: frame.load,
            acceleration: acceleration(frame),
            path: frame.path.to_vec(),
        });
        while self.past.len() > frames(frame.frame_s) {
            self.past.pop_front();
        }
        self.path.clear();
        self.path.extend(self.past.iter().flat_map(|past| &past.path));
        let share = 1.0 / self.past.len() as f64;
        self.past.iter().fold((Wrench::ZERO, DVec3::ZERO), |(load, acceleration), past| {
            (load + past.load * share, acceleration + past.acceleration * share)
        })
    }

    /// The law of what moves against the tool, and that of the lift, of the same places.
    fn laws(&mut self, frame: &FrameEnd<'_>, around: &Neighbourhood<'_>, pool: &Immersion) -> (Law, Law) {
        let (at, radius, stands) = (frame.felt_at, frame.radius, self.stands);
        self.stream.take(around.parcels(), NEAR * radius, (REACH - 1.0 - NEAR) * radius);
        let farthest = self.path.iter().map(|t| t.position.distance(at.position)).fold(0.0, f64::max);
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

/// A frame that is averaged with others.
#[derive(Debug)]
struct Past {
    load: Wrench,
    /// Acceleration of the tool, m/s².
    acceleration: DVec3,
    path: Vec<ToolState>,
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
    /// Takes a frame and gives β, times the share of the force that both explain, and m.
    fn take(&mut self, part: &Part, frame_s: f64) -> (f64, f64) {
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
    use std::f64::consts::PI;

    const RADIUS: f64 = 0.012;
    const SIDE: usize = 16;

    /// What is felt of a ball at rest deep in water that is lifted and pushed aside.
    fn felt(buoyancy_scale: f64, volume: f64, load: DVec3) -> DVec3 {
        let nodes = vec![[1.0, 0.0, 0.0, 0.0]; SIDE.pow(3)];
        let around = Neighbourhood {
            density: 1000.0,
            viscosity: 0.001,
            gravity: DVec3::NEG_Y * 9.81,
            origin: DVec3::splat(-3.0 * RADIUS),
            spacing: 6.0 * RADIUS / 15.0,
            side: SIDE,
            nodes: &nodes,
        };
        let tool = ToolState::default();
        let answer = Local::default().end_frame(&FrameEnd {
            body: BodyState::default(),
            load: Wrench::from_force(load),
            frame_s: 1.0 / 60.0,
            radius: RADIUS,
            volume,
            buoyancy_scale,
            path: &[tool],
            felt_at: tool,
            around: Some(around),
        });
        answer.wrench.force + answer.law.at(&tool)
    }

    #[test]
    fn the_lift_alone_is_scaled() {
        let volume = 4.0 / 3.0 * PI * RADIUS.powi(3);
        let (lift, push) = (DVec3::Y * (9810.0 * volume), DVec3::X * 0.2);
        for scale in [0.0, 1.0, 3.0] {
            let found = felt(scale, volume, lift + push);
            assert!((found - push - lift * scale).length() < 1e-6, "{scale}: {found}");
        }
    }

    #[test]
    fn a_load_of_numbers_that_are_none_is_handed_on() {
        assert!(!felt(1.0, 1e-6, DVec3::NAN).is_finite());
    }
}
