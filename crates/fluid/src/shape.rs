//! Shapes of the bodies that stand in the fluid.

use glam::{DQuat, DVec3, Vec3};

/// Shape of a body, in its own frame, centred at its origin.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

impl Shape {
    /// Radius of the smallest ball round the origin that holds the shape, m.
    pub fn bounding_radius(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => radius,
            Self::Disc { radius, thickness } => radius.hypot(0.5 * thickness),
        }
    }

    /// Volume, m³.
    pub fn volume(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3),
            Self::Disc { radius, thickness } => std::f64::consts::PI * radius * radius * thickness,
        }
    }

    /// Signed distance (m, negative inside) and outward unit normal at `point`, in the body frame.
    pub(crate) fn distance(&self, point: Vec3) -> (f32, Vec3) {
        match *self {
            Self::Sphere { radius } => {
                let length = point.length();
                let normal = if length > 1e-9 { point / length } else { Vec3::Y };
                (length - radius as f32, normal)
            }
            Self::Disc { radius, thickness } => disc_distance(point, radius as f32, 0.5 * thickness as f32),
        }
    }
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

    pub fn to_body(self, point: Vec3) -> Vec3 {
        self.rotation.inverse() * (point - self.position)
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
