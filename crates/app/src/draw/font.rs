//! Lettering.

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};

use super::image::Image;

/// The letters of every picture: Inter, under the SIL Open Font License.
pub(crate) const INTER: &[u8] = include_bytes!("../../fonts/Inter-Regular.ttf");

/// Writes one line of text.
pub(crate) struct Pen {
    font: FontRef<'static>,
    scale: PxScale,
}

impl Pen {
    /// A pen for letters of `size` pixels; none if the font cannot be read.
    pub fn new(size: f32) -> Option<Self> {
        Some(Self { font: FontRef::try_from_slice(INTER).ok()?, scale: PxScale::from(size) })
    }

    /// The glyphs of `text` along a base line that starts at the origin, and their width.
    fn lay_out(&self, text: &str) -> (Vec<Glyph>, f32) {
        let font = self.font.as_scaled(self.scale);
        let mut x = 0.0;
        let mut last = None;
        let mut glyphs = Vec::new();
        for letter in text.chars().filter(|c| !c.is_control()) {
            let id = font.glyph_id(letter);
            if let Some(last) = last {
                x += font.kern(last, id);
            }
            glyphs.push(id.with_scale_and_position(self.scale, point(x, 0.0)));
            x += font.h_advance(id);
            last = Some(id);
        }
        (glyphs, x)
    }

    /// Width of `text`, pixels.
    pub fn width(&self, text: &str) -> f32 {
        self.lay_out(text).1
    }

    /// Writes `text` on a base line that starts at `x`, `y`.
    pub fn write(&self, image: &mut Image, x: f32, y: f32, text: &str, colour: [u8; 3]) {
        self.draw(text, (x, y), |px, py, cover| image.blend(px, py, colour, cover));
    }

    /// Writes `text` upwards on a base line that starts at `x`, `y`.
    pub fn write_up(&self, image: &mut Image, x: f32, y: f32, text: &str, colour: [u8; 3]) {
        self.draw(text, (0.0, 0.0), |px, py, cover| {
            image.blend(x.round() as i64 + py, y.round() as i64 - px, colour, cover);
        });
    }

    /// Hands out every pixel of `text` on a base line that starts at `origin`, and how much of it is covered.
    fn draw(&self, text: &str, origin: (f32, f32), mut dot: impl FnMut(i64, i64, f32)) {
        for mut glyph in self.lay_out(text).0 {
            glyph.position.x += origin.0;
            glyph.position.y += origin.1;
            let Some(outline) = self.font.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|dx, dy, cover| {
                dot(corner.x as i64 + i64::from(dx), corner.y as i64 + i64::from(dy), cover);
            });
        }
    }
}
