//! Shapes of the bodies that stand in the fluid.

use crate::Mesh;
use glam::{DMat3, DQuat, DVec3, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// Shape of a body, in its own frame, centred at its origin. A slab and a drum have no end: they are for worlds
/// that are periodic along them, or bounded.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A ball.
    Sphere {
        /// Radius, m.
        radius: f64,
    },
    /// A flat round plate whose axis is the body's y axis.
    Disc {
        /// Radius, m.
        radius: f64,
        /// Thickness, m.
        thickness: f64,
    },
    /// A rod along the body's y axis with round ends.
    Capsule {
        /// Radius, m.
        radius: f64,
        /// Distance between the centres of its ends, m.
        length: f64,
    },
    /// A box with edges along the body's axes.
    Box {
        /// Lengths of its edges, m.
        size: DVec3,
    },
    /// What a closed mesh holds.
    Mesh(Arc<Mesh>),
    /// All between two parallel planes across the body's y axis.
    Slab {
        /// Distance of the planes, m.
        thickness: f64,
    },
    /// All outside a round tube along the body's y axis: the fluid is within.
    Drum {
        /// Inner radius, m.
        radius: f64,
    },
}

impl Shape {
    /// Radius of the smallest ball round the origin that holds the shape, m.
    pub fn bounding_radius(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => radius,
            Self::Disc { radius, thickness } => radius.hypot(0.5 * thickness),
            Self::Capsule { radius, length } => radius + 0.5 * length,
            Self::Box { size } => 0.5 * size.length(),
            Self::Mesh(ref mesh) => mesh.bounding_radius(),
            Self::Slab { .. } | Self::Drum { .. } => f64::INFINITY,
        }
    }

    /// Every length of the shape, m.
    pub(crate) fn lengths(&self) -> [f64; 3] {
        match *self {
            Self::Sphere { radius } | Self::Drum { radius } => [radius; 3],
            Self::Disc { radius, thickness } => [radius, thickness, radius],
            Self::Capsule { radius, length } => [radius, length, radius],
            Self::Box { size } => size.to_array(),
            Self::Mesh(ref mesh) => [mesh.bounding_radius(); 3],
            Self::Slab { thickness } => [thickness; 3],
        }
    }

    /// Mean curvature of the surface where it is round, 1/m; negative where the fluid is within.
    pub(crate) fn mean_curvature(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => 1.0 / radius,
            Self::Capsule { radius, .. } => 0.5 / radius,
            Self::Drum { radius } => -0.5 / radius,
            Self::Disc { .. } | Self::Box { .. } | Self::Mesh(_) | Self::Slab { .. } => 0.0,
        }
    }

    /// Tensor of inertia about the origin of a body of `mass` (kg) of even density, kg m²; infinite for a shape
    /// without end.
    pub fn inertia(&self, mass: f64) -> DMat3 {
        DMat3::from_diagonal(match *self {
            Self::Mesh(ref mesh) => return mesh.inertia(mass),
            Self::Sphere { radius } => DVec3::splat(0.4 * mass * radius * radius),
            Self::Disc { radius, thickness } => {
                let across = mass * (3.0 * radius * radius + thickness * thickness) / 12.0;
                DVec3::new(across, 0.5 * mass * radius * radius, across)
            }
            Self::Capsule { radius, length } => capsule_inertia(mass, radius, length),
            Self::Box { size } => {
                let s = size * size;
                mass / 12.0 * DVec3::new(s.y + s.z, s.x + s.z, s.x + s.y)
            }
            Self::Slab { .. } | Self::Drum { .. } => DVec3::INFINITY,
        })
    }

    /// Volume, m³; infinite for a shape without end.
    pub fn volume(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => 4.0 / 3.0 * PI * radius.powi(3),
            Self::Disc { radius, thickness } => PI * radius * radius * thickness,
            Self::Capsule { radius, length } => PI * radius * radius * (length + 4.0 / 3.0 * radius),
            Self::Box { size } => size.element_product(),
            Self::Mesh(ref mesh) => mesh.volume(),
            Self::Slab { .. } | Self::Drum { .. } => f64::INFINITY,
        }
    }

    /// Signed distance (m, negative inside) and outward unit normal at `point`, in the body frame.
    pub fn distance(&self, point: Vec3) -> (f32, Vec3) {
        match *self {
            Self::Sphere { radius } => ball_distance(point, radius as f32),
            Self::Disc { radius, thickness } => disc_distance(point, radius as f32, 0.5 * thickness as f32),
            Self::Capsule { radius, length } => {
                let half = 0.5 * length as f32;
                ball_distance(point - Vec3::Y * point.y.clamp(-half, half), radius as f32)
            }
            Self::Box { size } => box_distance(point, 0.5 * size.as_vec3()),
            Self::Mesh(ref mesh) => mesh.distance(point),
            Self::Slab { thickness } => {
                (point.y.abs() - 0.5 * thickness as f32, Vec3::new(0.0, 1.0_f32.copysign(point.y), 0.0))
            }
            Self::Drum { radius } => {
                let (outside, outward) = ball_distance(Vec3::new(point.x, 0.0, point.z), radius as f32);
                (-outside, -outward)
            }
        }
    }
}

/// Two half balls and a cylinder, each about the middle of the whole.
fn capsule_inertia(mass: f64, radius: f64, length: f64) -> DVec3 {
    let r2 = radius * radius;
    let ball = mass * 4.0 * radius / (4.0 * radius + 3.0 * length);
    let rod = mass - ball;
    let along = 0.5 * rod * r2 + 0.4 * ball * r2;
    // The centre of a half ball lies 3/8 radius from its flat side.
    let ends = ball * (0.4 * r2 + 0.25 * length * length + 0.375 * length * radius);
    let across = rod * (0.25 * r2 + length * length / 12.0) + ends;
    DVec3::new(across, along, across)
}

fn ball_distance(point: Vec3, radius: f32) -> (f32, Vec3) {
    let length = point.length();
    let normal = if length > 1e-9 { point / length } else { Vec3::Y };
    (length - radius, normal)
}

/// Signed distance to a box of half lengths `half`.
fn box_distance(point: Vec3, half: Vec3) -> (f32, Vec3) {
    let side = Vec3::ONE.copysign(point);
    let out = point.abs() - half;
    let beyond = out.max(Vec3::ZERO);
    let distance = beyond.length();
    if distance > 1e-9 {
        return (distance, side * beyond / distance);
    }
    let nearest = out.max_position();
    (out[nearest], Vec3::AXES[nearest] * side)
}

/// Signed distance to a cylinder of half height `half` round the y axis.
fn disc_distance(point: Vec3, radius: f32, half: f32) -> (f32, Vec3) {
    let axial = Vec3::new(0.0, point.y.signum(), 0.0);
    let across = Vec3::new(point.x, 0.0, point.z);
    let rho = across.length();
    let radial = if rho > 1e-9 { across / rho } else { Vec3::X };
    let (out_r, out_y) = (rho - radius, point.y.abs() - half);
    if out_r > 0.0 && out_y > 0.0 {
        let d = out_r.hypot(out_y).max(1e-9);
        ((d), (radial * out_r + axial * out_y) / d)
    } else if out_y > out_r {
        (out_y, axial)
    } else {
        (out_r, radial)
    }
}

/// Turns scene coordinates into body coordinates and back, in f32.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub position: Vec3,
    rotation: glam::Quat,
}

impl Frame {
    pub fn new(position: DVec3, orientation: DQuat) -> Self {
        Self { position: position.as_vec3(), rotation: orientation.as_quat() }
    }

    /// Turns a direction, or an arm from the body's origin, into the body's frame.
    pub fn to_body_direction(self, direction: Vec3) -> Vec3 {
        self.rotation.inverse() * direction
    }

    pub fn to_scene_direction(self, direction: Vec3) -> Vec3 {
        self.rotation * direction
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sphere_distance_is_radial() {
        let (d, n) = Shape::Sphere { radius: 0.5 }.distance(Vec3::new(0.0, 2.0, 0.0));
        assert!((d - 1.5).abs() < 1e-6 && (n - Vec3::Y).length() < 1e-6);
    }

    /// Away from edges a distance is one along its normal, and the foot lies on the surface.
    #[test]
    fn every_shape_has_the_distance_to_its_own_surface() {
        let shapes = [
            Shape::Sphere { radius: 0.3 },
            Shape::Disc { radius: 0.3, thickness: 0.2 },
            Shape::Capsule { radius: 0.1, length: 0.4 },
            Shape::Box { size: DVec3::new(0.2, 0.4, 0.6) },
            Shape::Slab { thickness: 0.2 },
            Shape::Drum { radius: 0.9 },
        ];
        for shape in shapes {
            for k in 0..400 {
                let s = |m: usize| ((k * m) % 101) as f32 / 101.0 - 0.5;
                let point = Vec3::new(s(7), s(13), s(29));
                let (d, n) = shape.distance(point);
                assert!((n.length() - 1.0).abs() < 1e-5, "{shape:?} {point}");
                assert!(shape.distance(point - d * n).0.abs() < 1e-5, "{shape:?} {point}");
            }
        }
    }

    /// Volume and inertia against sums over a lattice of points that the distance finds inside.
    #[test]
    fn volumes_and_inertias_are_those_of_the_distance() {
        let shapes = [
            Shape::Sphere { radius: 0.3 },
            Shape::Disc { radius: 0.3, thickness: 0.2 },
            Shape::Capsule { radius: 0.15, length: 0.4 },
            Shape::Box { size: DVec3::new(0.2, 0.4, 0.6) },
        ];
        for shape in shapes {
            let (n, mut volume, mut inertia) = (80, 0.0, DVec3::ZERO);
            let step = 0.8 / f64::from(n);
            let at = |k: i32| (f64::from(k) + 0.5) * step - 0.4;
            for x in 0..n {
                for y in 0..n {
                    for z in 0..n {
                        let p = DVec3::new(at(x), at(y), at(z));
                        if shape.distance(p.as_vec3()).0 < 0.0 {
                            volume += step.powi(3);
                            inertia += (DVec3::splat(p.length_squared()) - p * p) * step.powi(3);
                        }
                    }
                }
            }
            assert!((volume / shape.volume() - 1.0).abs() < 0.02, "{shape:?}: {volume}");
            let expected = shape.inertia(volume) * DVec3::ONE;
            assert!(((inertia - expected) / expected).abs().max_element() < 0.03, "{shape:?}: {inertia}");
        }
    }

    #[test]
    fn disc_distance_has_faces_side_and_rim() {
        let disc = Shape::Disc { radius: 1.0, thickness: 0.2 };
        let cases = [
            (Vec3::new(0.2, 0.3, 0.0), 0.2, Vec3::Y),
            (Vec3::new(0.0, -0.4, 0.1), 0.3, Vec3::NEG_Y),
            (Vec3::new(1.5, 0.0, 0.0), 0.5, Vec3::X),
            (Vec3::new(1.3, 0.5, 0.0), 0.5, Vec3::new(0.6, 0.8, 0.0)),
            (Vec3::new(0.0, 0.09, 0.0), -0.01, Vec3::Y),
        ];
        for (point, distance, normal) in cases {
            let (d, n) = disc.distance(point);
            assert!((d - distance).abs() < 1e-6, "{point}: {d}");
            assert!((n - normal).length() < 1e-5, "{point}: {n}");
        }
    }
}
