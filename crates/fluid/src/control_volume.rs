//! The balance of momentum of a box: the force on what stands in it, from the particles alone.
//!
//! ```text
//! force on the bodies = momentum in − momentum out, per second, − d/dt momentum inside + weight of what is inside
//! ```
//!
//! The box must cut only free streams, whose pressure is nothing. See any text on fluid mechanics, for instance
//! Batchelor 1967, An Introduction to Fluid Dynamics, section 3.2 (doi:10.1017/CBO9780511800955).

use crate::{Aabb, ParticleView};
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// Velocities by the particles' numbers.
type Velocities = HashMap<u32, DVec3>;

/// The water inside a box.
#[derive(Clone, Copy, Debug)]
pub struct ControlVolume {
    /// The box.
    pub volume: Aabb,
    /// Mass of a particle, kg.
    pub mass: f64,
    /// Gravity, m/s².
    pub gravity: DVec3,
}

impl ControlVolume {
    /// Impulse (N·s) on the bodies between two snapshots that are `dt` seconds apart.
    pub fn impulse(&self, before: &ParticleView, after: &ParticleView, dt: f64) -> DVec3 {
        let (all_before, all_after) = (all(before), all(after));
        let (old, new) = (self.inside(before), self.inside(after));
        // Somewhere between the snapshots a particle crossed the face: with the mean of its velocities. One that
        // was just born or has just vanished has only one.
        let crossing = |id: &u32| match (all_before.get(id), all_after.get(id)) {
            (Some(a), Some(b)) => 0.5 * (*a + *b),
            (one, other) => one.or(other).copied().unwrap_or(DVec3::ZERO),
        };
        let entered: DVec3 = new.keys().filter(|id| !old.contains_key(id)).map(crossing).sum();
        let left: DVec3 = old.keys().filter(|id| !new.contains_key(id)).map(crossing).sum();
        let growth = new.values().sum::<DVec3>() - old.values().sum::<DVec3>();
        let count = 0.5 * (old.len() + new.len()) as f64;
        self.mass * (entered - left - growth + self.gravity * count * dt)
    }

    fn inside(&self, view: &ParticleView) -> Velocities {
        let places = vectors(&view.positions).map(|x| self.volume.contains(x));
        let rows = view.ids.iter().zip(vectors(&view.velocities)).zip(places);
        rows.filter(|(_, here)| *here).map(|((&id, v), _)| (id, v)).collect()
    }
}

/// Rows of a snapshot in f64.
fn vectors(rows: &[[f32; 3]]) -> impl Iterator<Item = DVec3> {
    rows.iter().map(|r| Vec3::from(*r).as_dvec3())
}

fn all(view: &ParticleView) -> Velocities {
    view.ids.iter().copied().zip(vectors(&view.velocities)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(rows: &[(u32, f32, f32)]) -> ParticleView {
        ParticleView {
            ids: rows.iter().map(|r| r.0).collect(),
            positions: rows.iter().map(|r| [0.0, r.1, 0.0]).collect(),
            velocities: rows.iter().map(|r| [0.0, r.2, 0.0]).collect(),
            pressures: vec![0.0; rows.len()],
        }
    }

    fn balance(gravity: DVec3) -> ControlVolume {
        ControlVolume { volume: Aabb { min: DVec3::splat(-1.0), max: DVec3::ONE }, mass: 2.0, gravity }
    }

    #[test]
    fn a_stream_that_passes_leaves_nothing() {
        let before = view(&[(1, 1.5, -1.0), (2, 0.5, -1.0), (3, -0.5, -1.0)]);
        let after = view(&[(1, 0.5, -1.0), (2, -0.5, -1.0), (3, -1.5, -1.0)]);
        assert_eq!(balance(DVec3::ZERO).impulse(&before, &after, 1.0), DVec3::ZERO);
    }

    #[test]
    fn a_particle_that_is_stopped_hands_its_momentum_over() {
        let (before, after) = (view(&[(7, 0.5, -3.0)]), view(&[(7, 0.4, 0.0)]));
        assert_eq!(balance(DVec3::ZERO).impulse(&before, &after, 0.1), DVec3::NEG_Y * 6.0);
    }

    #[test]
    fn what_falls_freely_pushes_nothing_and_what_rests_weighs() {
        let gravity = DVec3::NEG_Y * 10.0;
        let (before, after) = (view(&[(7, 0.5, 0.0)]), view(&[(7, 0.45, -1.0)]));
        assert!(balance(gravity).impulse(&before, &after, 0.1).length() < 1e-12);
        assert_eq!(balance(gravity).impulse(&before, &before, 0.1), DVec3::NEG_Y * 2.0);
    }
}
