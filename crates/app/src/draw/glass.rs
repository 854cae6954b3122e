//! Open-topped glass boxes.

use glam::Vec3;

use super::camera::Ray;
use super::scene::Box3;
use super::sky::{fresnel, mirrored, smooth};

/// What one sheet of glass lets through.
const TINT: Vec3 = Vec3::new(0.955, 0.985, 0.978);
/// Colour of an edge.
const EDGE: Vec3 = Vec3::new(0.20, 0.40, 0.40);
/// Colour of the light along the middle of an edge.
const GLEAM: Vec3 = Vec3::new(0.90, 1.0, 0.98);

/// A clear layer that a ray passes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layer {
    pub t: f32,
    /// Light that the layer adds.
    pub add: Vec3,
    /// Share of the light behind it that it lets through.
    pub pass: Vec3,
}

/// All glass of the scene.
#[derive(Clone, Debug)]
pub(crate) struct Glass {
    boxes: Vec<(Vec3, Vec3)>,
    /// Half the width of an edge, m.
    edge: f32,
    /// Angle that a pixel covers, rad.
    pixel: f32,
}

impl Glass {
    /// The glass of `containers`; boxes that make no sense are left out.
    pub fn new(containers: &[Box3], size: f32, pixel: f32) -> Self {
        let sane = |b: &&Box3| {
            let (low, high) = (Vec3::from(b.min), Vec3::from(b.max));
            low.is_finite() && high.is_finite() && low.cmplt(high).all()
        };
        let corners = |b: &Box3| (Vec3::from(b.min), Vec3::from(b.max));
        Self { boxes: containers.iter().filter(sane).map(corners).collect(), edge: 0.0022 * size, pixel }
    }

    /// The layers that `ray` passes between `start` and `end`, nearest first.
    pub fn layers(&self, ray: &Ray, start: f32, end: f32) -> Vec<Layer> {
        let mut layers = Vec::new();
        for &(low, high) in &self.boxes {
            let widest = 2.0 * self.edge;
            if overlap(ray, low - widest, high + widest).is_none() {
                continue;
            }
            if let Some((enter, leave)) = overlap(ray, low, high) {
                layers.extend([enter, leave].into_iter().filter_map(|t| pane(ray, t, low, high)));
            }
            self.edges(ray, low, high, &mut layers);
        }
        layers.retain(|layer| layer.t > start && layer.t < end);
        layers.sort_by(|a, b| a.t.total_cmp(&b.t));
        layers
    }

    /// The twelve edges of a box.
    fn edges(&self, ray: &Ray, low: Vec3, high: Vec3, layers: &mut Vec<Layer>) {
        for axis in 0..3 {
            let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
            for corner in 0..4 {
                let mut from = low;
                if corner & 1 != 0 {
                    from[b] = high[b];
                }
                if corner & 2 != 0 {
                    from[c] = high[c];
                }
                layers.extend(self.edge(ray, from, axis, high[axis] - low[axis]));
            }
        }
    }

    /// The edge that starts at `from` and runs along `axis`.
    fn edge(&self, ray: &Ray, from: Vec3, axis: usize, length: f32) -> Option<Layer> {
        let off = from - ray.origin;
        let along = ray.direction[axis];
        let rest = 1.0 - along * along;
        if rest < 1e-6 {
            return None;
        }
        // The place on the edge nearest to the ray, then the place on the ray nearest to that.
        let s = ((along * off.dot(ray.direction) - off[axis]) / rest).clamp(0.0, length);
        let mut point = off;
        point[axis] += s;
        let t = point.dot(ray.direction);
        let distance = point.distance(ray.direction * t);
        let half = self.edge.max(0.8 * self.pixel * t);
        let cover = 0.8 * (1.0 - smooth(half - self.pixel * t, half + 0.5 * self.pixel * t, distance));
        let core = 1.0 - smooth(0.0, 0.7 * half, distance);
        (cover > 0.0).then(|| Layer {
            t,
            add: EDGE.lerp(GLEAM, 0.75 * core) * cover,
            pass: Vec3::splat(1.0 - cover),
        })
    }

    /// Whether light along `ray` passes a pane, and how often.
    pub fn panes(&self, ray: &Ray) -> i32 {
        let count = |&(low, high): &(Vec3, Vec3)| {
            let Some(ends) = overlap(ray, low, high) else { return 0 };
            [ends.0, ends.1]
                .into_iter()
                .filter(|t| *t > 0.0 && ray.at(*t).y < high.y - 1e-4 * self.edge)
                .count()
        };
        self.boxes.iter().map(count).sum::<usize>() as i32
    }
}

/// The pane that `ray` passes at `t`, unless that is the open top.
fn pane(ray: &Ray, t: f32, low: Vec3, high: Vec3) -> Option<Layer> {
    let p = ray.at(t);
    let (below, above) = ((p - low).abs(), (p - high).abs());
    let axis = below.min(above).min_position();
    if axis == 1 && above.y < below.y {
        return None;
    }
    let normal = Vec3::AXES[axis] * -ray.direction[axis].signum();
    let share = fresnel(0.02, ray.direction[axis].abs());
    let seen = mirrored(ray.direction.reflect(normal)).min(Vec3::ONE);
    Some(Layer { t, add: seen * share, pass: TINT * (1.0 - share) })
}

/// Where `ray` enters and leaves a box.
fn overlap(ray: &Ray, low: Vec3, high: Vec3) -> Option<(f32, f32)> {
    let inverse = ray.direction.recip();
    let (a, b) = ((low - ray.origin) * inverse, (high - ray.origin) * inverse);
    let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element());
    (enter < leave && leave > 0.0).then_some((enter, leave))
}
