//! The camera.

use glam::{Vec2, Vec3};

/// How far round to the right of the z axis the camera stands, rad.
const AZIMUTH: f32 = 0.48;
/// How far above the horizon it stands, rad.
const ELEVATION: f32 = 0.34;
/// Tangent of half the height of its view.
const HALF_HEIGHT: f32 = 0.25;
/// Share of the picture that the framed box may fill: across, and up.
const FILL: Vec2 = Vec2::new(0.9, 0.86);

/// A ray of light, followed backwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub origin: Vec3,
    /// Unit length.
    pub direction: Vec3,
}

impl Ray {
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}

/// A pinhole camera that frames a box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    eye: Vec3,
    right: Vec3,
    up: Vec3,
    ahead: Vec3,
    half: Vec2,
    size: Vec2,
}

impl Camera {
    /// A camera for a picture of `width` by `height` pixels that shows all of the box `low` to `high`.
    pub fn framing(low: Vec3, high: Vec3, width: u32, height: u32) -> Self {
        let (sin_a, cos_a) = AZIMUTH.sin_cos();
        let (sin_e, cos_e) = ELEVATION.sin_cos();
        let ahead = -Vec3::new(sin_a * cos_e, sin_e, cos_a * cos_e);
        let right = ahead.cross(Vec3::Y).normalize_or(Vec3::X);
        let up = right.cross(ahead);
        let size = Vec2::new(width.max(1) as f32, height.max(1) as f32);
        let half = Vec2::new(HALF_HEIGHT * size.x / size.y, HALF_HEIGHT);
        let mut camera = Self { eye: 0.5 * (low + high), right, up, ahead, half, size };
        camera.step_back(low, high);
        camera
    }

    /// Moves the eye until the box fits and its picture is centred.
    fn step_back(&mut self, low: Vec3, high: Vec3) {
        let middle = 0.5 * (low + high);
        let corners: [Vec3; 8] = std::array::from_fn(|i| {
            let pick = |bit: usize, a: f32, b: f32| if i & bit == 0 { a } else { b };
            Vec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z)) - middle
        });
        let mut shift = Vec2::ZERO;
        let mut back = 0.0_f32;
        for _ in 0..12 {
            back = corners.iter().map(|c| self.distance_for(*c, shift)).fold(0.0, f32::max);
            let (mut least, mut most) = (Vec2::splat(f32::MAX), Vec2::splat(f32::MIN));
            for corner in corners {
                let depth = (back + corner.dot(self.ahead)).max(1e-6);
                let seen = (Vec2::new(corner.dot(self.right), corner.dot(self.up)) - shift) / depth;
                (least, most) = (least.min(seen), most.max(seen));
            }
            shift += 0.5 * (least + most) * back;
        }
        self.eye = middle + self.right * shift.x + self.up * shift.y - self.ahead * back;
    }

    /// How far back the eye must stand to see `corner`.
    fn distance_for(&self, corner: Vec3, shift: Vec2) -> f32 {
        let off = (Vec2::new(corner.dot(self.right), corner.dot(self.up)) - shift).abs();
        (off / (self.half * FILL)).max_element() - corner.dot(self.ahead)
    }

    /// The ray through a point of the picture, in pixels from its upper left corner.
    pub fn ray(&self, x: f32, y: f32) -> Ray {
        let u = (2.0 * x / self.size.x - 1.0) * self.half.x;
        let v = (1.0 - 2.0 * y / self.size.y) * self.half.y;
        Ray { origin: self.eye, direction: (self.ahead + self.right * u + self.up * v).normalize() }
    }

    /// Where `point` appears, in pixels; none behind the eye.
    pub fn project(&self, point: Vec3) -> Option<Vec2> {
        let seen = point - self.eye;
        let depth = seen.dot(self.ahead);
        let place = Vec2::new(seen.dot(self.right), -seen.dot(self.up)) / (depth * self.half);
        (depth > 1e-6).then_some(0.5 * (place + Vec2::ONE) * self.size)
    }

    /// Angle that one pixel covers, rad.
    pub fn pixel_angle(&self) -> f32 {
        2.0 * self.half.y / self.size.y
    }
}
