//! What a frame shows.

use glam::{Quat, Vec3};
use hapflow_fluid::Shape;

/// Farthest from the origin that a picture may reach, m.
const FARTHEST: f32 = 1e4;

/// Everything that one frame shows, SI units, y up.
#[derive(Clone, Debug)]
pub struct Scene3d<'a> {
    /// Where the fluid's particles are, m.
    pub particles: &'a [[f32; 3]],
    /// How fast they are, m/s; a missing one counts as still.
    pub speeds: &'a [f32],
    /// Distance between particles at rest, m.
    pub spacing: f32,
    /// The tool that the hand holds.
    pub tool: Tool,
    /// What else is solid.
    pub obstacles: &'a [Tool],
    /// Open-topped glass boxes.
    pub containers: &'a [Box3],
    /// Height of the ground, m; none for a picture without ground.
    pub ground_y: Option<f32>,
    /// Taps that the fluid comes from.
    pub sources: &'a [Nozzle],
    /// Force on the hand, N, drawn as an arrow from the tool.
    pub force: Option<[f32; 3]>,
    /// Lowest and highest corner of what the camera must frame, m.
    pub bounds: ([f32; 3], [f32; 3]),
    /// One line of text for the lower left corner; empty for none.
    pub caption: &'a str,
}

/// A solid thing, such as the tool, and where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Its shape.
    pub shape: Shape,
    /// Its centre, m.
    pub position: [f32; 3],
    /// Its orientation, a quaternion x, y, z, w.
    pub orientation: [f32; 4],
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box3 {
    /// Lowest corner, m.
    pub min: [f32; 3],
    /// Highest corner, m.
    pub max: [f32; 3],
}

/// A round mouth that fluid leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nozzle {
    /// Centre of the mouth, m.
    pub position: [f32; 3],
    /// Which way the fluid leaves.
    pub direction: [f32; 3],
    /// Diameter of the mouth, m.
    pub diameter: f32,
}

impl Tool {
    /// How it is turned.
    pub(crate) fn turn(&self) -> Quat {
        let turn = Quat::from_array(self.orientation).normalize();
        if turn.is_finite() { turn } else { Quat::IDENTITY }
    }
}

impl Scene3d<'_> {
    /// The corners to frame, in order and finite, never without extent.
    pub(crate) fn framed(&self) -> (Vec3, Vec3) {
        let (a, b) = (Vec3::from(self.bounds.0), Vec3::from(self.bounds.1));
        let near = |v: Vec3| v.is_finite() && v.abs().max_element() < FARTHEST;
        if !near(a) || !near(b) {
            return (Vec3::splat(-0.1), Vec3::splat(0.1));
        }
        let (low, high) = (a.min(b), a.max(b));
        let least = Vec3::splat(0.5e-3);
        let middle = 0.5 * (low + high);
        (low.min(middle - least), high.max(middle + least))
    }

    /// Distance between particles at rest, m, always positive.
    pub(crate) fn safe_spacing(&self) -> f32 {
        if self.spacing.is_finite() && self.spacing > 1e-5 { self.spacing } else { 5e-3 }
    }
}
