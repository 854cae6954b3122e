//! How solid things look.

use glam::Vec3;

use super::sky::{SUN, ambient, fresnel, mirrored, mirrored_ground, sun_direction};

/// Colour and gloss of a solid thing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Material {
    /// Share of light that it scatters, linear.
    pub colour: Vec3,
    /// Share of light that it mirrors when looked at head on.
    pub mirror: Vec3,
}

/// The tool.
pub(crate) const LACQUER: Material =
    Material { colour: Vec3::new(0.62, 0.018, 0.014), mirror: Vec3::splat(0.05) };
/// The tap.
pub(crate) const STEEL: Material =
    Material { colour: Vec3::new(0.10, 0.11, 0.12), mirror: Vec3::new(0.56, 0.58, 0.60) };
/// The arrow of the force.
pub(crate) const SIGNAL: Material =
    Material { colour: Vec3::new(0.95, 0.40, 0.02), mirror: Vec3::splat(0.03) };

impl Material {
    /// The light that leaves the surface towards the eye; `floor` is the light of a ground below.
    pub fn shade(&self, normal: Vec3, looking: Vec3, floor: Option<Vec3>) -> Vec3 {
        let sun = SUN * normal.dot(sun_direction()).max(0.0);
        let diffuse = self.colour * (ambient(normal) + sun);
        let bounce = looking.reflect(normal);
        let seen = match floor {
            Some(light) if bounce.y < 0.0 => mirrored_ground(bounce, light),
            _ => mirrored(bounce),
        };
        let cosine = -looking.dot(normal);
        let share = self.mirror.map(|facing| fresnel(facing, cosine));
        diffuse + share * seen
    }
}
