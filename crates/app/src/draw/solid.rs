//! Solid shapes that rays meet.

use glam::{Quat, Vec3};
use hapflow_fluid::Shape;

use super::camera::Ray;
use super::material::Material;

/// A solid thing.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    pub form: Form,
    pub material: Material,
}

/// Its form.
#[derive(Clone, Debug)]
pub(crate) enum Form {
    /// A ball.
    Ball { centre: Vec3, radius: f32 },
    /// A cone with flat ends, `radii` at the base and at the far end; a cylinder if they are equal.
    Cone { base: Vec3, axis: Vec3, length: f32, radii: [f32; 2] },
    /// Any shape that has an end.
    Shaped { shape: Shape, centre: Vec3, turn: Quat },
}

/// Where a ray meets a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub t: f32,
    pub normal: Vec3,
    pub material: Material,
}

impl Solid {
    /// The first place beyond `start` where `ray` meets the solid from outside.
    pub fn hit(&self, ray: &Ray, start: f32) -> Option<Hit> {
        let (t, normal) = match self.form {
            Form::Shaped { ref shape, centre, turn } => march(ray, start, shape, centre, turn)?,
            Form::Ball { centre, radius } => ball(ray, start, centre, radius)?,
            Form::Cone { base, axis, length, radii } => cone(ray, start, base, axis, length, radii)?,
        };
        Some(Hit { t, normal, material: self.material })
    }
}

impl Solid {
    /// Signed distance of `p` (negative inside) and the way out; not for cones.
    pub fn distance(&self, p: Vec3) -> Option<(f32, Vec3)> {
        match self.form {
            Form::Ball { centre, radius } => {
                let off = p - centre;
                Some((off.length() - radius, off.normalize_or(Vec3::Y)))
            }
            Form::Cone { base, axis, length, radii } if radii[0] == radii[1] => {
                Some(cylinder_distance(p - base - axis * (0.5 * length), axis, 0.5 * length, radii[0]))
            }
            Form::Cone { .. } => None,
            Form::Shaped { ref shape, centre, turn } => {
                let (distance, normal) = shape.distance(turn.inverse() * (p - centre));
                Some((distance, turn * normal))
            }
        }
    }
}

fn cylinder_distance(off: Vec3, axis: Vec3, half: f32, radius: f32) -> (f32, Vec3) {
    let height = off.dot(axis);
    let across = off - axis * height;
    let (end, side) = (axis * height.signum(), across.normalize_or(axis.any_orthonormal_vector()));
    let (rise, rim) = (height.abs() - half, across.length() - radius);
    if rise > 0.0 && rim > 0.0 {
        let distance = rise.hypot(rim);
        return (distance, (end * rise + side * rim) / distance);
    }
    if rise > rim { (rise, end) } else { (rim, side) }
}

/// The nearest of `solids` that `ray` meets between `start` and `end`.
pub(crate) fn nearest(solids: &[Solid], ray: &Ray, start: f32, end: f32) -> Option<Hit> {
    let hits = solids.iter().filter_map(|solid| solid.hit(ray, start)).filter(|hit| hit.t < end);
    hits.min_by(|a, b| a.t.total_cmp(&b.t))
}

fn ball(ray: &Ray, start: f32, centre: Vec3, radius: f32) -> Option<(f32, Vec3)> {
    let off = ray.origin - centre;
    let b = off.dot(ray.direction);
    let closest = off - ray.direction * b;
    let half = radius * radius - closest.length_squared();
    let t = -b - half.sqrt();
    // Past the ball the root, and with it t, is not a number.
    (t > start).then(|| (t, (ray.at(t) - centre) / radius))
}

fn cone(ray: &Ray, start: f32, base: Vec3, axis: Vec3, length: f32, radii: [f32; 2]) -> Option<(f32, Vec3)> {
    let side = mantle(ray, start, base, axis, length, radii);
    let ends = [(0.0, -axis, radii[0]), (length, axis, radii[1])];
    let caps = ends.into_iter().filter_map(|(h, out, r)| cap(ray, start, base + axis * h, out, r));
    side.into_iter().chain(caps).min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Steps of a march, and how near to the surface it ends, in sizes of the shape.
const MOST_STEPS: usize = 256;
const NEAR: f32 = 1e-4;

/// Goes along the ray by the distance that is free (sphere tracing: Hart 1996, doi:10.1007/s003710050084).
fn march(ray: &Ray, start: f32, shape: &Shape, centre: Vec3, turn: Quat) -> Option<(f32, Vec3)> {
    let reach = shape.bounding_radius() as f32;
    let off = ray.origin - centre;
    let along = -off.dot(ray.direction);
    let half = (reach * reach - (off + ray.direction * along).length_squared()).sqrt();
    let mut t = start.max(along - half);
    for _ in 0..MOST_STEPS {
        // Past the ball round it `half`, and with it this, is not a number.
        if t.is_nan() || t > along + half {
            return None;
        }
        let (distance, normal) = shape.distance(turn.inverse() * (ray.at(t) - centre));
        let normal = turn * normal;
        if distance < NEAR * reach && normal.dot(ray.direction) < 0.0 {
            return (t > start).then_some((t, normal));
        }
        t += distance.max(NEAR * reach);
    }
    None
}

/// The round side of a cone.
fn mantle(
    ray: &Ray,
    start: f32,
    base: Vec3,
    axis: Vec3,
    length: f32,
    [r0, r1]: [f32; 2],
) -> Option<(f32, Vec3)> {
    let off = ray.origin - base;
    let (oy, dy) = (off.dot(axis), ray.direction.dot(axis));
    let (o, d) = (off - axis * oy, ray.direction - axis * dy);
    let slope = (r1 - r0) / length;
    let (ro, rd) = (r0 + slope * oy, slope * dy);
    let (a, b, c) = (d.length_squared() - rd * rd, o.dot(d) - ro * rd, o.length_squared() - ro * ro);
    let root = (b * b - a * c).sqrt();
    if root.is_nan() || a.abs() < 1e-12 {
        return None;
    }
    let t = [(-b - root) / a, (-b + root) / a].into_iter().filter(|t| {
        let h = oy + dy * t;
        *t > start && h > 0.0 && h < length && (o + d * *t).dot(d) - (ro + rd * *t) * rd < 0.0
    });
    let t = t.min_by(f32::total_cmp)?;
    let out = (o + d * t).normalize_or(Vec3::Y);
    Some((t, (out - axis * slope).normalize_or(out)))
}

/// A flat end.
fn cap(ray: &Ray, start: f32, centre: Vec3, out: Vec3, radius: f32) -> Option<(f32, Vec3)> {
    let fall = ray.direction.dot(out);
    if fall >= 0.0 {
        return None;
    }
    let t = (centre - ray.origin).dot(out) / fall;
    (t > start && ray.at(t).distance_squared(centre) < radius * radius).then_some((t, out))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_march_meets_a_turned_box_from_outside_only() {
        let shape = Shape::Box { size: glam::DVec3::new(2.0, 1.0, 1.0) };
        let turn = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
        let ray = |x: f32, z: f32| Ray { origin: Vec3::new(x, 0.0, z), direction: Vec3::NEG_Z };
        let (t, normal) = march(&ray(0.0, 5.0), 0.0, &shape, Vec3::ZERO, turn).unwrap();
        assert!((t - 4.0).abs() < 1e-3 && normal.abs_diff_eq(Vec3::Z, 1e-5), "{t} {normal}");
        assert!(march(&ray(0.6, 5.0), 0.0, &shape, Vec3::ZERO, turn).is_none());
        assert!(march(&ray(0.0, -1.0), 0.0, &shape, Vec3::ZERO, turn).is_none(), "away from its own surface");
    }

    #[test]
    fn rays_meet_the_near_side() {
        let ray = Ray { origin: Vec3::new(0.0, 0.0, 5.0), direction: Vec3::NEG_Z };
        let (t, normal) = ball(&ray, 0.0, Vec3::ZERO, 1.0).unwrap();
        assert!((t - 4.0).abs() < 1e-5 && normal.abs_diff_eq(Vec3::Z, 1e-5));
        let (t, normal) = cone(&ray, 0.0, Vec3::NEG_Y, Vec3::Y, 2.0, [1.0, 1.0]).unwrap();
        assert!((t - 4.0).abs() < 1e-5 && normal.abs_diff_eq(Vec3::Z, 1e-5));
        let (t, normal) = cone(&ray, 0.0, Vec3::NEG_Z, Vec3::Z, 2.0, [1.0, 0.5]).unwrap();
        assert!((t - 4.0).abs() < 1e-5 && normal.abs_diff_eq(Vec3::Z, 1e-5));
    }
}
