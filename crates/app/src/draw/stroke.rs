//! Smooth lines.

use super::image::Image;

/// A part of a picture that lines are drawn into, cut off at its rim.
pub(crate) struct Stroke {
    left: i64,
    top: i64,
    width: usize,
    height: usize,
    cover: Vec<f32>,
}

impl Stroke {
    /// The part `width` by `height` pixels whose upper left pixel is at `left`, `top`.
    pub fn new(left: i64, top: i64, width: usize, height: usize) -> Self {
        Self { left, top, width, height, cover: vec![0.0; width * height] }
    }

    /// Draws a line through `points`, in pixels of the picture; one that is not finite breaks it.
    pub fn line(&mut self, points: impl Iterator<Item = [f32; 2]>, thick: f32) {
        let mut last: Option<[f32; 2]> = None;
        for point in points {
            let here = [point[0] - self.left as f32, point[1] - self.top as f32];
            if !(here[0].is_finite() && here[1].is_finite()) {
                last = None;
                continue;
            }
            self.segment(last.unwrap_or(here), here, 0.5 * thick);
            last = Some(here);
        }
    }

    /// Covers the pixels near the segment from `a` to `b`.
    fn segment(&mut self, a: [f32; 2], b: [f32; 2], half: f32) {
        let reach = half + 1.0;
        let limit = |low: f32, high: f32, most: usize| {
            let first = (low - reach).floor().clamp(0.0, most as f32) as usize;
            (first, (high + reach).ceil().clamp(0.0, most as f32) as usize)
        };
        let (left, right) = limit(a[0].min(b[0]), a[0].max(b[0]), self.width);
        let (top, bottom) = limit(a[1].min(b[1]), a[1].max(b[1]), self.height);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let square = (dx * dx + dy * dy).max(1e-12);
        for y in top..bottom {
            for x in left..right {
                let (px, py) = (x as f32 + 0.5 - a[0], y as f32 + 0.5 - a[1]);
                let along = ((px * dx + py * dy) / square).clamp(0.0, 1.0);
                let distance = (px - along * dx).hypot(py - along * dy);
                let cover = &mut self.cover[y * self.width + x];
                *cover = cover.max((half + 0.5 - distance).clamp(0.0, 1.0));
            }
        }
    }

    /// Lays what was drawn on the picture.
    pub fn ink(&self, image: &mut Image, colour: [u8; 3], alpha: f32) {
        for (i, cover) in self.cover.iter().enumerate().filter(|(_, cover)| **cover > 0.0) {
            let (x, y) = ((i % self.width) as i64, (i / self.width) as i64);
            image.blend(self.left + x, self.top + y, colour, alpha * cover);
        }
    }
}

/// Fills a rectangle whose corners need not lie on pixels.
pub(crate) fn fill(image: &mut Image, corners: [f32; 4], colour: [u8; 3], alpha: f32) {
    let [left, top, right, bottom] = corners;
    let share =
        |i: i64, from: f32, to: f32| ((i as f32 + 1.0).min(to) - (i as f32).max(from)).clamp(0.0, 1.0);
    for y in top.floor() as i64..bottom.ceil() as i64 {
        for x in left.floor() as i64..right.ceil() as i64 {
            image.blend(x, y, colour, alpha * share(x, left, right) * share(y, top, bottom));
        }
    }
}
