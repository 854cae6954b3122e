//! A place on a path, and how fast it is passed.

use glam::DVec3;

/// Where something is, and how it moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PathPoint {
    /// Position, m.
    pub position: DVec3,
    /// Velocity, m/s.
    pub velocity: DVec3,
}

impl PathPoint {
    /// At rest at `position`.
    pub fn at_rest(position: DVec3) -> Self {
        Self { position, velocity: DVec3::ZERO }
    }
}
