//! The arrow that shows the force on the hand.

use glam::Vec3;

use super::material::SIGNAL;
use super::scene::Scene3d;
use super::solid::{Form, Solid};

/// Least force that gets an arrow, N.
const LEAST: f32 = 0.01;
/// Force whose arrow has about 0.63 of the greatest length, N.
const SCALE: f32 = 3.0;

/// An arrow from the tool along the force.
#[derive(Clone, Debug)]
pub(crate) struct Arrow {
    pub solids: Vec<Solid>,
    pub tip: Vec3,
    /// The size of the force, N.
    pub force: f32,
}

impl Arrow {
    /// The arrow of the scene's force, if there is one; `size` is the extent of the picture, m.
    pub fn new(scene: &Scene3d, size: f32) -> Option<Self> {
        let force = Vec3::from(scene.force?);
        let (tool, strength) = (Vec3::from(scene.tool.position), force.length());
        if !(strength > LEAST && strength.is_finite() && tool.is_finite()) {
            return None;
        }
        let axis = force / strength;
        let thick = 0.0085 * size;
        let head = 4.6 * thick;
        let length = head + 0.24 * size * (1.0 - (-strength / SCALE).exp());
        let base = tool + axis * (0.9 * scene.tool.shape.bounding_radius() as f32);
        let part = |from: f32, length: f32, radii: [f32; 2]| Solid {
            form: Form::Cone { base: base + axis * from, axis, length, radii },
            material: SIGNAL,
        };
        let shaft = part(0.0, length - head, [thick; 2]);
        let solids = vec![shaft, part(length - head, head, [2.3 * thick, 0.02 * thick])];
        Some(Self { solids, tip: base + axis * length, force: strength })
    }
}
