//! Solids that a tool can touch: convex shapes with a pose and a motion.

use glam::{DQuat, DVec3};

/// Shape of a solid, in its own frame. All of them are convex, which the proxy builds on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SolidShape {
    /// Everything below y = 0.
    HalfSpace,
    /// A ball round the origin.
    Sphere {
        /// Radius, m.
        radius: f64,
    },
    /// A flat round plate round the origin, its axis y.
    Disc {
        /// Radius, m.
        radius: f64,
        /// Thickness, m.
        thickness: f64,
    },
    /// A rod along the y axis with round ends, about the origin.
    Capsule {
        /// Radius, m.
        radius: f64,
        /// Distance between the centres of its ends, m.
        length: f64,
    },
    /// A box round the origin, its edges along the axes.
    Box {
        /// Half of its edges, m.
        half: DVec3,
    },
}

impl SolidShape {
    /// Radius of the ball round the origin that holds what of it can turn, m; 0 for a half-space, which does not.
    pub fn reach(&self) -> f64 {
        match *self {
            Self::HalfSpace => 0.0,
            Self::Sphere { radius } => radius,
            Self::Disc { radius, thickness } => radius.hypot(0.5 * thickness),
            Self::Capsule { radius, length } => radius + 0.5 * length,
            Self::Box { half } => half.length(),
        }
    }

    /// Signed distance of `point` (m, negative inside) and outward unit normal there.
    fn distance(&self, point: DVec3) -> (f64, DVec3) {
        match *self {
            Self::HalfSpace => (point.y, DVec3::Y),
            Self::Sphere { radius } => ball_distance(point, radius),
            Self::Capsule { radius, length } => {
                let half = 0.5 * length;
                ball_distance(point - DVec3::Y * point.y.clamp(-half, half), radius)
            }
            Self::Disc { radius, thickness } => {
                let across = DVec3::new(point.x, 0.0, point.z);
                let radial = across.try_normalize().unwrap_or(DVec3::X);
                let axial = DVec3::Y * point.y.signum();
                let out = DVec3::new(across.length() - radius, point.y.abs() - 0.5 * thickness, f64::MIN);
                outside(out, [radial, axial, DVec3::Z])
            }
            Self::Box { half } => {
                let sign = point.signum();
                outside(point.abs() - half, [DVec3::X * sign.x, DVec3::Y * sign.y, DVec3::Z * sign.z])
            }
        }
    }
}

fn ball_distance(point: DVec3, radius: f64) -> (f64, DVec3) {
    (point.length() - radius, point.try_normalize().unwrap_or(DVec3::Y))
}

/// Distance and normal where a point is `out` metres beyond each of three pairs of faces, whose outward `normals` are
/// at right angles.
fn outside(out: DVec3, normals: [DVec3; 3]) -> (f64, DVec3) {
    let beyond = out.max(DVec3::ZERO);
    let distance = beyond.length();
    if distance > 0.0 {
        let normal = normals[0] * beyond.x + normals[1] * beyond.y + normals[2] * beyond.z;
        return (distance, normal / distance);
    }
    let nearest = out.max_position();
    (out[nearest], normals[nearest])
}

/// Where a solid is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Position of its origin, m.
    pub position: DVec3,
    /// Orientation, unit quaternion, its frame to the scene's.
    pub orientation: DQuat,
}

impl Pose {
    /// Upright at `position`.
    pub fn at(position: DVec3) -> Self {
        Self { position, orientation: DQuat::IDENTITY }
    }

    /// `share` (0..1) of the way to `other`.
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        Self {
            position: self.position.lerp(other.position, share),
            orientation: self.orientation.slerp(other.orientation, share),
        }
    }
}

/// What a solid is in the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SolidKind {
    /// The ground.
    #[default]
    Ground,
    /// A wall of the container: 0 the floor, 1 and 2 those at the smallest and largest x, 3 and 4 those of z.
    Container,
    /// An obstacle, by its place in the scene.
    Obstacle,
}

/// Something that a tool can touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// What it is.
    pub kind: SolidKind,
    /// Which of that kind, from 0.
    pub index: u32,
    /// Its shape.
    pub shape: SolidShape,
    /// Where it is.
    pub pose: Pose,
    /// Velocity of its origin, m/s.
    pub velocity: DVec3,
    /// Angular velocity in the scene's frame, rad/s.
    pub angular_velocity: DVec3,
}

impl Solid {
    /// One that rests.
    pub fn at_rest(kind: SolidKind, index: u32, shape: SolidShape, pose: Pose) -> Self {
        Self { kind, index, shape, pose, velocity: DVec3::ZERO, angular_velocity: DVec3::ZERO }
    }

    /// Signed distance of `point` from its surface (m, negative inside), and the outward unit normal there.
    pub fn distance(&self, point: DVec3) -> (f64, DVec3) {
        let own = self.pose.orientation.conjugate() * (point - self.pose.position);
        let (distance, normal) = self.shape.distance(own);
        (distance, self.pose.orientation * normal)
    }

    /// Velocity of its matter at `point`, m/s.
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.velocity + self.angular_velocity.cross(point - self.pose.position)
    }
}

/// The ground at a height, m.
pub fn ground(height: f64) -> Solid {
    Solid::at_rest(SolidKind::Ground, 0, SolidShape::HalfSpace, Pose::at(DVec3::Y * height))
}

/// Floor and walls of an open box whose inside lies between `min` and `max` (m), each `thickness` metres thick.
pub fn open_box(min: DVec3, max: DVec3, thickness: f64) -> [Solid; 5] {
    let (low, high) = (min - thickness, DVec3::new(max.x + thickness, max.y, max.z + thickness));
    let corners = [
        (low, DVec3 { y: min.y, ..high }),
        (low, DVec3 { x: min.x, ..high }),
        (DVec3 { x: max.x, ..low }, high),
        (low, DVec3 { z: min.z, ..high }),
        (DVec3 { z: max.z, ..low }, high),
    ];
    std::array::from_fn(|k| {
        let (from, to) = corners[k];
        let shape = SolidShape::Box { half: 0.5 * (to - from) };
        Solid::at_rest(SolidKind::Container, k as u32, shape, Pose::at(0.5 * (from + to)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn met(solid: &Solid, point: [f64; 3]) -> (f64, DVec3) {
        solid.distance(DVec3::from(point))
    }

    fn close(found: (f64, DVec3), distance: f64, normal: DVec3) {
        assert!((found.0 - distance).abs() < 1e-12 && (found.1 - normal).length() < 1e-12, "{found:?}");
    }

    #[test]
    fn distances_are_known() {
        let still = |shape| Solid::at_rest(SolidKind::Obstacle, 0, shape, Pose::at(DVec3::X));
        let ball = still(SolidShape::Sphere { radius: 0.5 });
        close(met(&ball, [1.0, 2.0, 0.0]), 1.5, DVec3::Y);
        close(met(&ball, [1.0, 0.0, 0.0]), -0.5, DVec3::Y);
        let disc = still(SolidShape::Disc { radius: 1.0, thickness: 0.2 });
        close(met(&disc, [1.2, 0.3, 0.0]), 0.2, DVec3::Y);
        close(met(&disc, [1.0, -0.4, 0.1]), 0.3, DVec3::NEG_Y);
        close(met(&disc, [2.3, 0.5, 0.0]), 0.5, DVec3::new(0.6, 0.8, 0.0));
        close(met(&disc, [1.0, 0.09, 0.0]), -0.01, DVec3::Y);
        let rod = still(SolidShape::Capsule { radius: 0.1, length: 1.0 });
        close(met(&rod, [1.3, 0.2, 0.0]), 0.2, DVec3::X);
        close(met(&rod, [1.0, -0.8, 0.0]), 0.2, DVec3::NEG_Y);
        close(met(&ground(0.3), [7.0, 0.1, 0.0]), -0.2, DVec3::Y);
    }

    #[test]
    fn an_open_box_has_a_floor_and_four_walls_from_both_sides() {
        let walls = open_box(DVec3::ZERO, DVec3::new(1.0, 0.5, 2.0), 0.1);
        let distances = walls.map(|w| met(&w, [0.2, 0.3, 0.9]).0);
        for (distance, expected) in distances.into_iter().zip([0.3, 0.2, 0.8, 0.9, 1.1]) {
            assert!((distance - expected).abs() < 1e-12, "{distances:?}");
        }
        close(met(&walls[1], [-0.3, 0.2, 1.0]), 0.2, DVec3::NEG_X);
        close(met(&walls[4], [0.5, 0.9, 2.05]), 0.4, DVec3::Y);
        close(met(&walls[0], [0.5, -0.3, 1.0]), 0.2, DVec3::NEG_Y);
    }

    #[test]
    fn a_solid_turns_and_moves_with_its_pose() {
        let pose =
            Pose { position: DVec3::Y, orientation: DQuat::from_rotation_z(0.5 * std::f64::consts::PI) };
        let plate = Solid {
            angular_velocity: DVec3::Z * 2.0,
            ..Solid::at_rest(SolidKind::Obstacle, 0, SolidShape::Disc { radius: 1.0, thickness: 0.2 }, pose)
        };
        close(met(&plate, [-0.3, 1.2, 0.0]), 0.2, DVec3::NEG_X);
        assert_eq!(plate.velocity_at(DVec3::new(0.0, 1.5, 0.0)), DVec3::NEG_X);
        let half = Pose::at(DVec3::ZERO).towards(&pose, 0.5);
        assert!((half.position - DVec3::Y * 0.5).length() < 1e-12);
        assert!((half.orientation.to_axis_angle().1 - 0.25 * std::f64::consts::PI).abs() < 1e-12);
    }
}
