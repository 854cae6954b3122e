//! The tap that a jet comes from.

use glam::Vec3;

use super::material::STEEL;
use super::scene::Nozzle;
use super::solid::{Form, Solid};

impl Nozzle {
    /// A short steel tube with two collars above the mouth; nothing if the mouth makes no sense.
    pub(crate) fn solids(&self) -> Vec<Solid> {
        let mouth = Vec3::from(self.position);
        let up = -Vec3::from(self.direction).normalize_or_zero();
        let r = 0.5 * self.diameter;
        let sane = mouth.is_finite() && up.is_normalized() && r > 0.0 && r.is_finite();
        if !sane {
            return vec![];
        }
        let part = |from: f32, length: f32, radii: [f32; 2]| Solid {
            form: Form::Cone {
                base: mouth + up * (from * r),
                axis: up,
                length: length * r,
                radii: radii.map(|x| x * r),
            },
            material: STEEL,
        };
        vec![
            part(0.0, 0.5, [1.22, 1.22]),
            part(0.5, 0.35, [1.22, 1.08]),
            part(0.85, 1.5, [1.08, 1.08]),
            part(2.35, 0.5, [1.08, 1.45]),
            part(2.85, 0.8, [1.45, 1.45]),
            part(3.65, 0.2, [1.45, 1.3]),
        ]
    }
}
