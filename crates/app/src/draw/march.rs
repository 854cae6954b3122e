//! Where rays cross the surface of the fluid.

use glam::Vec3;

use super::camera::Ray;
use super::field::{CELLS, Content, Field, SURFACE};

/// Step through a block that has some surface, in cells.
const STEP: f32 = 0.7;

impl Field {
    /// Whether `p` lies in the fluid.
    pub fn wet(&self, p: Vec3) -> bool {
        self.sample(p) >= SURFACE
    }

    /// The unit normal out of the fluid at a point of its surface.
    pub fn normal(&self, p: Vec3) -> Vec3 {
        self.wall_normal(p).unwrap_or_else(|| (-self.slope(p)).normalize_or(Vec3::Y))
    }

    /// How far along `ray` its next crossing of the surface lies, beyond `start` and before `end`.
    ///
    /// `wet` says whether the ray is in the fluid at `start`.
    pub fn crossing(&self, ray: &Ray, start: f32, end: f32, wet: bool) -> Option<f32> {
        let side = self.cell * CELLS as f32;
        let (enter, leave) = self.overlap(ray)?;
        if enter > start && wet {
            return Some(start);
        }
        let nudge = 1e-3 * self.cell;
        let mut t = start.max(enter + nudge);
        let last = end.min(leave - nudge);
        let inverse = ray.direction.recip();
        while t < last {
            let block = ((ray.at(t) - self.low) / side).floor().as_ivec3();
            let Some(content) = self.content(block) else { break };
            let corner = self.low + block.as_vec3() * side;
            let exits = ((corner - ray.origin) * inverse).max((corner + side - ray.origin) * inverse);
            let exit = exits.min_element().max(t) + nudge;
            match content {
                Content::Empty if wet => return Some(t),
                Content::Full if !wet => return Some(t),
                Content::Mixed(slot) => {
                    if let Some(hit) = self.crossing_in(slot, corner, ray, (t, exit.min(last)), wet) {
                        return Some(hit);
                    }
                }
                _ => {}
            }
            t = exit;
        }
        (wet && leave < end).then_some(leave.max(start))
    }

    /// The part of `ray` that lies in the grid.
    fn overlap(&self, ray: &Ray) -> Option<(f32, f32)> {
        let high = self.low + self.blocks.as_vec3() * (self.cell * CELLS as f32);
        let inverse = ray.direction.recip();
        let (a, b) = ((self.low - ray.origin) * inverse, (high - ray.origin) * inverse);
        let (enter, leave) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
        (enter < leave).then_some((enter, leave))
    }

    /// The first crossing within one block.
    fn crossing_in(
        &self,
        slot: usize,
        corner: Vec3,
        ray: &Ray,
        (from, to): (f32, f32),
        wet: bool,
    ) -> Option<f32> {
        let scale = 1.0 / self.cell;
        let (origin, direction) = ((ray.origin - corner) * scale, ray.direction * scale);
        let above = |t: f32| self.sample_block(slot, origin + direction * t) - SURFACE;
        let step = STEP * self.cell;
        let mut before = (from, above(from));
        if (before.1 >= 0.0) != wet {
            return Some(from);
        }
        while before.0 < to {
            let t = (before.0 + step).min(to);
            let after = (t, above(t));
            if (after.1 >= 0.0) != wet {
                return Some(refine(before, after, above));
            }
            before = after;
        }
        None
    }
}

/// Narrows down a change of sign between two points.
fn refine(mut a: (f32, f32), mut b: (f32, f32), value: impl Fn(f32) -> f32) -> f32 {
    for _ in 0..3 {
        let gap = a.1 - b.1;
        let share = if gap.abs() > 1e-9 { (a.1 / gap).clamp(0.05, 0.95) } else { 0.5 };
        let t = a.0 + (b.0 - a.0) * share;
        let middle = (t, value(t));
        if (middle.1 >= 0.0) == (a.1 >= 0.0) { a = middle } else { b = middle }
    }
    let gap = a.1 - b.1;
    if gap.abs() > 1e-9 { a.0 + (b.0 - a.0) * (a.1 / gap).clamp(0.0, 1.0) } else { b.0 }
}
