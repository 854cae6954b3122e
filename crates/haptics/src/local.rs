//! The coupling `local`, on the fluid's side.

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
/// Largest factor on the law.
const MOST: f64 = 3.0;

/// See [`CouplingKind::Local`](crate::CouplingKind::Local).
///
/// The fluid's load on the led tool is split into a law, which says how the force changes with the tool's place and velocity,
/// and the rest: F = (F̄ − β L̄) + β L(x, v), with means over the frame's path and β the ratio of both in the last time.
#[derive(Debug, Default)]
pub(crate) struct Local {
    stream: Stream,
    /// Means of F·L and L·L over the last time, N².
    force_law: f64,
    law_law: f64,
}

impl Coupling for Local {
    fn leads(&self) -> bool {
        true
    }

    fn looks(&self, radius: f64) -> Option<f64> {
        Some(REACH * radius)
    }

    fn begin_frame(&mut self, _: &BodyState, _: &ToolState, _: f64) -> Drive {
        Drive::Led
    }

    fn end_frame(&mut self, frame: &FrameEnd<'_>) -> Answer {
        let Some(around) = &frame.around else { return Answer { wrench: frame.load, law: Law::default() } };
        let law = self.law(frame, around);
        let law = law.scaled(self.fit(frame.load.force, mean_force(&law, frame.path), frame.frame_s));
        Answer { wrench: frame.load - Wrench::from_force(mean_force(&law, frame.path)), law }
    }
}

impl Local {
    fn law(&mut self, frame: &FrameEnd<'_>, around: &Neighbourhood<'_>) -> Law {
        self.stream.take(around.parcels(), NEAR * frame.radius, (REACH - 1.0 - NEAR) * frame.radius);
        let at = frame.felt_at;
        let farthest = frame.path.iter().map(|t| t.position.distance(at.position)).fold(0.0, f64::max);
        let spacing = (SPACING[0] * frame.radius).max(SPACING[1] * frame.frame_s).max(farthest);
        let force = |place| -> LawNode { self.stream.force(frame.radius, place, at.velocity) };
        Law::tabulate(at.position, at.velocity, spacing, force)
    }

    /// How large the law must be for the fluid's force to be its own.
    fn fit(&mut self, force: DVec3, law: DVec3, frame_s: f64) -> f64 {
        let share = 1.0 - (-frame_s / FIT_S).exp();
        self.force_law += (force.dot(law) - self.force_law) * share;
        self.law_law += (law.length_squared() - self.law_law) * share;
        if self.law_law > 1e-12 { (self.force_law / self.law_law).clamp(0.0, MOST) } else { 0.0 }
    }
}

/// Mean of a law over a path, N.
fn mean_force(law: &Law, path: &[ToolState]) -> DVec3 {
    path.iter().map(|tool| law.at(tool)).sum::<DVec3>() / path.len().max(1) as f64
}
