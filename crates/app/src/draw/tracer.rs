//! Light that reaches the eye.

use glam::Vec3;

use super::camera::Ray;
use super::field::Field;
use super::floor::Floor;
use super::glass::Glass;
use super::photons::AIR_TO_WATER;
use super::sky::{SUN, ambient, backdrop, fresnel, mirrored, mirrored_ground, smooth, sun_direction};
use super::solid::{Hit, Solid, nearest};

/// Most surfaces of the fluid that a ray passes.
const MOST_SURFACES: usize = 7;
/// Light that the water itself sends back, once deep.
const BODY: Vec3 = Vec3::new(0.02, 0.20, 0.30);
/// Share of light that water mirrors when looked at head on.
const WATER: f32 = 0.02;
/// Share of the sun that foam scatters.
const FOAM: Vec3 = Vec3::new(0.80, 0.84, 0.86);

/// Everything that sends light to the eye.
pub(crate) struct Tracer {
    pub field: Field,
    pub solids: Vec<Solid>,
    pub arrow: Vec<Solid>,
    pub glass: Glass,
    pub floor: Option<Floor>,
    /// Light that a metre of water swallows.
    pub murk: Vec3,
    /// Depth over which the water's own colour comes up, 1/m.
    pub haze: f32,
}

/// A ray on its way, and the light gathered so far.
struct Path {
    ray: Ray,
    start: f32,
    wet: bool,
    travelled: f32,
    weight: Vec3,
    light: Vec3,
}

/// What a ray meets next.
enum Meeting {
    Surface(f32),
    Solid(Hit),
    Ground(f32),
    Nothing,
}

impl Tracer {
    /// Light along `ray`, linear, with the hidden part of the arrow showing through.
    pub fn look(&self, ray: Ray) -> Vec3 {
        let light = self.follow(ray);
        match nearest(&self.arrow, &ray, 0.0, f32::MAX) {
            Some(hit) => light.lerp(self.shade(&ray, &hit), 0.6),
            None => light,
        }
    }

    /// Light along `ray`.
    fn follow(&self, ray: Ray) -> Vec3 {
        let wet = self.field.wet(ray.origin);
        let mut path = Path { ray, start: 0.0, wet, travelled: 0.0, weight: Vec3::ONE, light: Vec3::ZERO };
        for _ in 0..MOST_SURFACES {
            let meeting = self.meet(&path);
            self.pass(&mut path, &meeting);
            match meeting {
                Meeting::Surface(t) => self.cross(&mut path, t),
                Meeting::Solid(hit) => return path.light + path.weight * self.shade(&path.ray, &hit),
                Meeting::Ground(t) => return path.light + path.weight * self.ground(&path, t),
                Meeting::Nothing => break,
            }
            if path.weight.max_element() < 0.01 {
                return path.light;
            }
        }
        path.light + path.weight * self.beyond(&path.ray)
    }

    fn meet(&self, path: &Path) -> Meeting {
        let ground = self.floor.as_ref().and_then(|floor| floor.hit(&path.ray)).filter(|t| *t > path.start);
        let end = ground.unwrap_or(f32::MAX);
        let solid = nearest(&self.solids, &path.ray, path.start, end);
        let arrow = nearest(&self.arrow, &path.ray, path.start, solid.map_or(end, |hit| hit.t));
        let solid = arrow.or(solid);
        let end = solid.map_or(end, |hit| hit.t);
        // The fluid lies flush with the ground, where it has no surface of its own to bend light.
        let margin = if solid.is_none() && ground.is_some() { 0.6 * self.field.cell } else { 0.0 };
        match (self.field.crossing(&path.ray, path.start, end - margin, path.wet), solid, ground) {
            (Some(t), _, _) => Meeting::Surface(t),
            (None, Some(hit), _) => Meeting::Solid(hit),
            (None, None, Some(t)) => Meeting::Ground(t),
            _ => Meeting::Nothing,
        }
    }

    /// What the way to the next meeting does to the light.
    fn pass(&self, path: &mut Path, meeting: &Meeting) {
        let end = match meeting {
            Meeting::Surface(t) | Meeting::Ground(t) => *t,
            Meeting::Solid(hit) => hit.t,
            Meeting::Nothing => f32::MAX,
        };
        if path.wet {
            self.dim(path, end);
            return;
        }
        let margin = 0.3 * self.field.cell;
        for layer in self.glass.layers(&path.ray, path.start - margin, end + margin) {
            path.light += path.weight * layer.add;
            path.weight *= layer.pass;
        }
    }

    /// Swallows light on the way through water, and adds the water's own.
    fn dim(&self, path: &mut Path, end: f32) {
        let way = (end - path.start).clamp(0.0, 1e3);
        let left = (-self.murk * way).exp();
        let own = 1.0 - (-self.haze * way).exp();
        path.light += path.weight * BODY * own;
        path.weight *= left * (1.0 - own);
    }

    /// Takes a ray through the surface of the fluid at `t`.
    fn cross(&self, path: &mut Path, t: f32) {
        let (ray, cell) = (path.ray, self.field.cell);
        let point = ray.at(t);
        let normal = self.field.normal(point);
        let facing = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
        let ratio = if path.wet { 1.0 / AIR_TO_WATER } else { AIR_TO_WATER };
        let bent = ray.direction.refract(facing, ratio);
        path.travelled += t;
        path.start = 0.03 * cell;
        if bent.length_squared() < 0.5 {
            // Thrown back whole.
            path.ray = Ray { origin: point, direction: ray.direction.reflect(facing) };
            return;
        }
        let share = fresnel(WATER, -ray.direction.dot(facing).min(0.0));
        let bounce = Ray { origin: point, direction: ray.direction.reflect(facing) };
        if !path.wet {
            path.light += path.weight * share * self.mirror(&bounce);
            self.froth(path, point, normal);
        }
        path.weight *= 1.0 - share;
        path.ray = Ray { origin: point, direction: bent.normalize() };
        path.wet = !path.wet;
    }

    /// The white of foam on the surface.
    fn froth(&self, path: &mut Path, point: Vec3, normal: Vec3) {
        let inside = point - normal * (0.5 * self.field.cell);
        let cover = 0.7 * smooth(0.15, 0.9, self.field.foam(inside));
        let light = ambient(normal) + SUN * (0.5 + 0.5 * normal.dot(sun_direction())).max(0.0);
        path.light += path.weight * cover * FOAM * light;
        path.weight *= 1.0 - cover;
    }

    /// What the surface of the fluid mirrors.
    fn mirror(&self, ray: &Ray) -> Vec3 {
        let ground = self.floor.as_ref().and_then(|floor| floor.hit(ray));
        if let Some(hit) = nearest(&self.solids, ray, self.field.cell, ground.unwrap_or(f32::MAX)) {
            return self.shade(ray, &hit);
        }
        match (&self.floor, ground) {
            (Some(floor), Some(_)) => mirrored_ground(ray.direction, floor.glow()),
            _ => mirrored(ray.direction),
        }
    }

    fn shade(&self, ray: &Ray, hit: &Hit) -> Vec3 {
        hit.material.shade(hit.normal, ray.direction, self.floor.as_ref().map(Floor::glow))
    }

    fn ground(&self, path: &Path, t: f32) -> Vec3 {
        self.floor.as_ref().map_or(Vec3::ZERO, |floor| floor.shade(&path.ray, t, path.travelled))
    }

    fn beyond(&self, ray: &Ray) -> Vec3 {
        backdrop(ray.direction)
    }
}
