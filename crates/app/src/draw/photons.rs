//! Sunlight that reaches the ground: shadows, and the bright lines under water.

use glam::{Vec2, Vec3};

use super::camera::Ray;
use super::field::Field;
use super::glass::Glass;
use super::sky::sun_direction;
use super::solid::{Solid, nearest};

/// Photons along each side of the lit square, and texels along each side of the map.
const SIDE: usize = 400;
/// How many photons get through one more pane.
const PANE: f32 = 0.97;
/// Ratio of the speeds of light in air and in water.
pub(crate) const AIR_TO_WATER: f32 = 1.0 / 1.33;

/// Light on a square of the ground.
pub(crate) struct LightMap {
    low: Vec2,
    texel: f32,
    sun: Vec<Vec3>,
    sky: Vec<Vec3>,
}

/// What stands between the sun and the ground.
#[derive(Clone, Copy)]
pub(crate) struct Shade<'a> {
    pub field: &'a Field,
    pub solids: &'a [Solid],
    pub glass: &'a Glass,
    /// Light that a metre of water swallows.
    pub murk: Vec3,
}

impl LightMap {
    /// The light on the square of half side `half` round `centre`.
    pub fn new(shade: Shade, centre: Vec3, half: f32) -> Self {
        let low = Vec2::new(centre.x - half, centre.z - half);
        let texel = 2.0 * half / SIDE as f32;
        let mut map = Self { low, texel, sun: vec![Vec3::ZERO; SIDE * SIDE], sky: vec![] };
        for i in 0..SIDE * SIDE {
            let place = low + (Vec2::new((i % SIDE) as f32, (i / SIDE) as f32) + 0.5) * texel;
            let target = Vec3::new(place.x, centre.y, place.y);
            let distance = 6.0 * half;
            let ray = Ray { origin: target + sun_direction() * distance, direction: -sun_direction() };
            if let Some((landing, light)) = shade.follow(ray, centre.y) {
                map.add(landing, light);
            }
        }
        map.finish();
        map
    }

    fn add(&mut self, landing: Vec3, light: Vec3) {
        let g = (Vec2::new(landing.x, landing.z) - self.low) / self.texel - 0.5;
        let base = g.floor();
        let f = g - base;
        for (dx, dy, share) in [
            (0, 0, (1.0 - f.x) * (1.0 - f.y)),
            (1, 0, f.x * (1.0 - f.y)),
            (0, 1, (1.0 - f.x) * f.y),
            (1, 1, f.x * f.y),
        ] {
            let (x, y) = (base.x as i64 + dx, base.y as i64 + dy);
            if (0..SIDE as i64).contains(&x) && (0..SIDE as i64).contains(&y) {
                self.sun[y as usize * SIDE + x as usize] += light * share;
            }
        }
    }

    /// Fills the rim that photons from outside would have lit, and blurs.
    fn finish(&mut self) {
        for i in 0..SIDE * SIDE {
            let (x, y) = (i % SIDE, i / SIDE);
            if x.min(y) < 1 || x.max(y) > SIDE - 2 {
                self.sun[i] = Vec3::ONE;
            }
        }
        let dim: Vec<Vec3> = self.sun.iter().map(|light| light.min(Vec3::ONE)).collect();
        self.sky = blur(&blur(&dim, SIDE / 28), SIDE / 28);
        self.sun = blur(&blur(&self.sun, 1), 1);
    }

    /// Light of the sun and of the sky at a point of the ground, 1 where nothing shades it.
    pub fn at(&self, p: Vec3) -> (Vec3, Vec3) {
        let g = ((Vec2::new(p.x, p.z) - self.low) / self.texel - 0.5)
            .clamp(Vec2::ZERO, Vec2::splat(SIDE as f32 - 1.001));
        let base = g.floor();
        let f = g - base;
        let i = base.y as usize * SIDE + base.x as usize;
        let pick = |map: &[Vec3]| {
            let near = map[i].lerp(map[i + 1], f.x);
            near.lerp(map[i + SIDE].lerp(map[i + SIDE + 1], f.x), f.y)
        };
        (pick(&self.sun), pick(&self.sky))
    }
}

impl Shade<'_> {
    /// Follows light down to the ground at height `ground`: where it lands and what is left of it.
    fn follow(&self, mut ray: Ray, ground: f32) -> Option<(Vec3, Vec3)> {
        let mut light = Vec3::splat(PANE.powi(self.glass.panes(&ray)));
        let mut wet = false;
        let mut start = 0.0;
        for _ in 0..5 {
            let end = (ground - ray.origin.y) / ray.direction.y;
            if !(end > 0.0 && end.is_finite()) {
                return None;
            }
            let surface = self.field.crossing(&ray, start, end - 0.5 * self.field.cell, wet);
            let reach = surface.unwrap_or(end);
            if nearest(self.solids, &ray, start, reach).is_some() {
                return None;
            }
            if wet {
                light *= (-self.murk * (reach - start).max(0.0)).exp();
            }
            if surface.is_none() {
                return Some((ray.at(end), light));
            }
            ray = self.bend(&ray, reach, &mut wet);
            start = 0.02 * self.field.cell;
        }
        None
    }

    /// The ray beyond the surface at `t`; straight on where it would be thrown back.
    fn bend(&self, ray: &Ray, t: f32, wet: &mut bool) -> Ray {
        let origin = ray.at(t);
        let normal = self.field.normal(origin);
        let (facing, ratio) = if *wet { (-normal, 1.0 / AIR_TO_WATER) } else { (normal, AIR_TO_WATER) };
        let bent = ray.direction.refract(facing, ratio);
        *wet = !*wet;
        Ray { origin, direction: if bent.length_squared() > 0.5 { bent.normalize() } else { ray.direction } }
    }
}

/// Box blur along both axes.
fn blur(map: &[Vec3], radius: usize) -> Vec<Vec3> {
    let mut across = map.to_vec();
    for row in 0..SIDE {
        blur_line(map, &mut across, row * SIDE, 1, radius);
    }
    let mut down = across.clone();
    for column in 0..SIDE {
        blur_line(&across, &mut down, column, SIDE, radius);
    }
    down
}

fn blur_line(from: &[Vec3], to: &mut [Vec3], first: usize, step: usize, radius: usize) {
    let get = |i: isize| from[first + step * i.clamp(0, SIDE as isize - 1) as usize];
    let reach = radius as isize;
    let mut sum = (-reach..=reach).map(get).sum::<Vec3>();
    let share = 1.0 / (2 * radius + 1) as f32;
    for i in 0..SIDE as isize {
        to[first + step * i as usize] = sum * share;
        sum += get(i + reach + 1) - get(i - reach);
    }
}
