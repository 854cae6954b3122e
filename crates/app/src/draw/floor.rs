//! The ground.

use glam::{Vec2, Vec3};

use super::camera::Ray;
use super::photons::LightMap;
use super::sky::{SUN, ambient, backdrop, smooth, sun_direction};

/// Share of light that the ground scatters.
const PAINT: Vec3 = Vec3::new(0.60, 0.615, 0.625);
/// The same on a line of its grid.
const LINE: Vec3 = Vec3::new(0.26, 0.32, 0.37);

/// A level ground with a grid, which fades into the backdrop.
pub(crate) struct Floor {
    pub height: f32,
    centre: Vec3,
    /// Half the extent of what stands on it, m.
    half: f32,
    /// Distance of the grid's lines, m.
    pub step: f32,
    light: LightMap,
    pixel: f32,
}

impl Floor {
    /// The ground under `centre`, lit by `light`; `pixel` is the angle that a pixel covers.
    pub fn new(centre: Vec3, half: f32, light: LightMap, pixel: f32) -> Self {
        Self { height: centre.y, centre, half, step: step(half), light, pixel }
    }

    /// Where `ray` meets the ground.
    pub fn hit(&self, ray: &Ray) -> Option<f32> {
        let t = (self.height - ray.origin.y) / ray.direction.y;
        (ray.direction.y < 0.0 && t > 0.0 && t.is_finite()).then_some(t)
    }

    /// Light from the ground along `ray`, which meets it at `t`.
    pub fn shade(&self, ray: &Ray, t: f32, travelled: f32) -> Vec3 {
        let p = ray.at(t);
        let (sun, sky) = self.light.at(p);
        let paint = PAINT.lerp(LINE, self.line(p, ray, t + travelled));
        let light = ambient(Vec3::Y) * (0.25 + 0.75 * sky) + SUN * sun_direction().y * sun;
        let far = p.distance(self.centre) / self.half;
        (paint * light).lerp(backdrop(ray.direction), smooth(1.4, 4.2, far))
    }

    /// How much a line of the grid covers the view of `p`, 0 to 1.
    fn line(&self, p: Vec3, ray: &Ray, t: f32) -> f32 {
        let size = self.pixel * t;
        let along = Vec2::new(ray.direction.x, ray.direction.z).normalize_or_zero().abs();
        let blur = size + along * (size / ray.direction.y.abs().max(0.05) - size);
        let off = Vec2::new(p.x, p.z) / self.step;
        let off = (off - off.round()).abs() * self.step;
        let half = 0.0016 * self.half;
        let cover = |off: f32, blur: f32| {
            ((half + 0.5 * blur - off) / blur).clamp(0.0, 1.0) * (2.0 * half / blur).clamp(0.0, 1.0)
        };
        let fade = 1.0 - smooth(0.8, 2.6, p.distance(self.centre) / self.half);
        0.6 * fade * cover(off.x, blur.x).max(cover(off.y, blur.y))
    }

    /// The light of the ground as shiny things mirror it.
    pub fn glow(&self) -> Vec3 {
        PAINT * (ambient(Vec3::Y) * 0.7 + SUN * 0.5)
    }
}

/// A round step that fits a few times into `half`.
fn step(half: f32) -> f32 {
    let want = half / 3.0;
    let decade = 10.0_f32.powf(want.max(1e-6).log10().floor());
    let share = want / decade;
    decade
        * if share > 5.0 {
            5.0
        } else if share > 2.0 {
            2.0
        } else {
            1.0
        }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_steps_are_round() {
        assert!((step(0.2) - 0.05).abs() < 1e-6);
        assert!((step(0.09) - 0.02).abs() < 1e-6);
    }
}
