//! Axes along which the world repeats.
//!
//! A particle that leaves on one side comes in on the other. Neighbours across a side are met as images: copies of
//! the particles near it, one period away, made before each sort and gone after the sub-step. The pair loops know
//! nothing of it, and a world that does not repeat makes none.

use crate::particles::Particles;
use crate::{Aabb, World};
use glam::Vec3;

/// The repeating axes of a world: where the period begins and how long it is, m.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Periodic {
    axes: [Option<(f32, f32)>; 3],
}

impl Periodic {
    pub fn new(world: &World) -> Self {
        let (low, size) = (world.bounds.min.as_vec3(), (world.bounds.max - world.bounds.min).as_vec3());
        Self { axes: std::array::from_fn(|a| world.periodic[a].then_some((low[a], size[a]))) }
    }

    /// Whether any axis repeats.
    pub fn any(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }

    /// The place of `p` within the period.
    pub fn wrap(&self, mut p: Vec3) -> Vec3 {
        for (a, axis) in self.axes.iter().enumerate() {
            if let Some((low, length)) = *axis
                && p[a].is_finite()
            {
                // Rounding may give the upper end itself, which is the lower one's place.
                p[a] = low + (p[a] - low).rem_euclid(length);
                p[a] = if p[a] < low + length { p[a] } else { low };
            }
        }
        p
    }

    /// Whether `p` has left `bounds`, which an axis that repeats has no end in.
    pub fn has_left(&self, bounds: &Aabb, p: Vec3) -> bool {
        let (p, min, max) = (p.as_dvec3(), bounds.min, bounds.max);
        (0..3).any(|a| self.axes[a].is_none() && !(min[a]..=max[a]).contains(&p[a]))
    }

    /// The shortest arm among those to the images of a point.
    pub fn shortest(&self, mut arm: Vec3) -> Vec3 {
        for (a, axis) in self.axes.iter().enumerate() {
            if let Some((_, length)) = *axis {
                arm[a] -= length * (arm[a] / length).round();
            }
        }
        arm
    }

    /// Adds to `images` a copy of each live particle within `support` of a side, one period away: pairs of the
    /// particle and the copy's place. A particle in a corner gets three or seven.
    pub fn images(&self, particles: &Particles, dead: &[bool], support: f32, images: &mut Vec<(u32, Vec3)>) {
        images.clear();
        for (a, axis) in self.axes.iter().enumerate() {
            let Some((low, length)) = *axis else { continue };
            let before = images.len();
            let real = (0..particles.len()).filter(|&i| !dead[i]).map(|i| (i as u32, particles.position(i)));
            let earlier: Vec<_> = images[..before].to_vec();
            for (owner, p) in real.chain(earlier) {
                let mut beside = |shift: f32| {
                    let mut image = p;
                    image[a] += shift;
                    images.push((owner, image));
                };
                if p[a] - low < support {
                    beside(length);
                }
                if low + length - p[a] < support {
                    beside(-length);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particles::Newborn;
    use glam::DVec3;

    fn world(periodic: [bool; 3]) -> World {
        let bounds = Aabb { min: DVec3::splat(-1.0), max: DVec3::new(1.0, 2.0, 3.0) };
        World { bounds, periodic, ..World::default() }
    }

    #[test]
    fn what_leaves_comes_in_on_the_other_side() {
        let p = Periodic::new(&world([true, false, true]));
        let wrapped = p.wrap(Vec3::new(1.25, 5.0, -1.5));
        assert!((wrapped - Vec3::new(-0.75, 5.0, 2.5)).length() < 1e-6, "{wrapped}");
        assert!(p.wrap(Vec3::splat(-1.0 - 1e-9)).x < 1.0);
        assert_eq!(p.shortest(Vec3::new(1.5, 1.5, -2.5)), Vec3::new(-0.5, 1.5, 1.5));
        assert!(!Periodic::new(&world([false; 3])).any());
        // A side that single precision puts beside its place is no way out.
        let bounds = Aabb { min: DVec3::splat(-0.1), max: DVec3::splat(0.1) };
        let beside = Vec3::new(-0.1 - 1e-8, 0.0, 0.1 + 1e-8);
        assert!(!p.has_left(&bounds, beside) && p.has_left(&bounds, Vec3::Y));
    }

    #[test]
    fn a_corner_has_seven_images_and_the_middle_none() {
        let mut particles = Particles::new();
        let at = |p: Vec3| Newborn { position: p, ..Newborn::default() };
        particles.extend(&[at(Vec3::splat(-0.95)), at(Vec3::splat(0.5)), at(Vec3::splat(-0.95))]);
        let mut images = Vec::new();
        let periodic = Periodic::new(&world([true; 3]));
        periodic.images(&particles, &[false, false, true], 0.1, &mut images);
        assert_eq!(images.len(), 7);
        assert!(images.iter().all(|(owner, _)| *owner == 0));
        assert!(images.iter().any(|(_, p)| (*p - Vec3::new(1.05, 2.05, 3.05)).length() < 1e-6));
    }
}
