//! The force of a stream that strikes a tool.
//!
//! Each parcel of the fluid before the tool goes on straight until it meets the surface, and there loses its velocity
//! along the normal: F = Σ m (w·n) n (w·e) φ/L, with e the way that the parcel goes, w its velocity against the tool's, and
//! φ/L the share of it that arrives now, a window over its way L. The way is that of the parcel and not of w: what arrives now
//! left the outlet earlier, where the stream was the same; along w it would meet the tool where that is only going to be.
//! What has been slowed by the tool itself, close to it, does not count; so the law knows which part of the tool is hit, and
//! how fast the undisturbed stream comes.

use crate::law::LawNode;
use crate::neighbourhood::Parcel;
use glam::{DVec3, Mat3, Vec3};

/// A stream, as parcels.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stream {
    parcels: Vec<Parcel>,
    /// Way over which parcels count, m.
    way: f32,
    /// Way from the surface within which they do not, m.
    near: f32,
}

impl Stream {
    /// Takes `parcels` that count from `near` to `near + way` metres before the surface.
    pub fn take(&mut self, parcels: impl Iterator<Item = Parcel>, near: f64, way: f64) {
        self.parcels.clear();
        self.parcels.extend(parcels);
        (self.near, self.way) = (near as f32, way as f32);
    }

    /// The force on a ball of `radius` (m) at `place` with `velocity`, and its slope by that velocity.
    pub fn force(&self, radius: f64, place: DVec3, velocity: DVec3) -> LawNode {
        let (radius, place, velocity) = (radius as f32, place.as_vec3(), velocity.as_vec3());
        let mut sum = LawNode::ZERO;
        for parcel in &self.parcels {
            let speed = parcel.velocity.length();
            let along = parcel.velocity / speed;
            let Some((way, normal)) = hit(parcel.place - place, along, radius) else { continue };
            let share = (way - self.near) / self.way;
            if !(share > 0.0 && share < 1.0) {
                continue;
            }
            let arriving = parcel.mass * 30.0 * (share * (1.0 - share)).powi(2) / self.way;
            let w = parcel.velocity - velocity;
            let (into, onto) = (w.dot(normal), w.dot(along));
            sum.force += normal * (arriving * onto * into);
            // With the hit held still.
            sum.by_velocity -= outer(normal, normal * onto + along * into) * arriving;
        }
        sum
    }
}

/// a bᵀ.
fn outer(a: Vec3, b: Vec3) -> Mat3 {
    Mat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// Way (m) from `from` along the unit vector `along` to the ball of `radius` round the origin, and its outward normal
/// there; none for what misses it or has passed.
fn hit(from: Vec3, along: Vec3, radius: f32) -> Option<(f32, Vec3)> {
    let middle = -from.dot(along);
    let square = radius * radius - (from.length_squared() - middle * middle);
    if !(middle > 0.0 && square > 0.0) {
        return None;
    }
    let way = middle - square.sqrt();
    Some((way, (from + along * way) / radius))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A jet of `radius` down the y axis at 2 m/s, as parcels of 1 mm.
    fn jet(radius: f64) -> Stream {
        let mut parcels = Vec::new();
        for k in 0..40 * 40 * 60 {
            let place =
                DVec3::new((k % 40) as f64 - 19.5, (k / 1600) as f64, (k / 40 % 40) as f64 - 19.5) * 1e-3;
            if DVec3::new(place.x, 0.0, place.z).length() < radius {
                parcels.push(Parcel { place: place.as_vec3(), velocity: Vec3::NEG_Y * 2.0, mass: 1e-6 });
            }
        }
        let mut stream = Stream::default();
        stream.take(parcels.into_iter(), 0.002, 0.03);
        stream
    }

    /// On the axis a narrow jet gives ρ A v², one that is as wide as 2/3 of the ball what its normals leave:
    /// 1 − r²/2R²; a moving ball feels the relative speed.
    #[test]
    fn a_jet_on_a_ball_gives_what_its_normals_say() {
        for radius in [0.003, 0.01] {
            let stream = jet(radius);
            let area = stream.parcels.iter().filter(|p| p.place.y.abs() < 1e-6).count() as f64 * 1e-6;
            let expected = 1000.0 * area * 4.0 * (1.0 - radius * radius / (2.0 * 0.015 * 0.015));
            let node = stream.force(0.015, DVec3::ZERO, DVec3::ZERO);
            assert!((f64::from(-node.force.y) / expected - 1.0).abs() < 0.02, "{}", node.force);
            assert!(node.force.x.abs() < 1e-4 && node.force.z.abs() < 1e-4);
            let moving = stream.force(0.015, DVec3::ZERO, DVec3::Y * 0.1);
            assert!((moving.force.y / node.force.y - 1.05_f32.powi(2)).abs() < 1e-3);
            let slope = (moving.force.y - node.force.y) / 0.1;
            assert!((node.by_velocity.y_axis.y / slope - 1.0).abs() < 0.03, "{}", node.by_velocity);
        }
    }

    #[test]
    fn off_the_axis_it_is_pushed_aside_and_below_and_beside_it_feels_nothing() {
        let stream = jet(0.008);
        let push = |x: f64, y: f64| stream.force(0.015, DVec3::new(x, y, 0.0), DVec3::ZERO).force;
        assert!(push(0.008, 0.0).x > 0.02 && (push(0.008, 0.0).x + push(-0.008, 0.0).x).abs() < 1e-3);
        assert_eq!(push(0.03, 0.0), Vec3::ZERO);
        assert_eq!(push(0.0, 0.2), Vec3::ZERO);
    }
}
