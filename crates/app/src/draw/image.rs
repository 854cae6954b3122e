//! A picture in memory.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use super::error::DrawError;

/// A picture: rows from the top, pixels from the left, sRGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue of every pixel.
    pub pixels: Vec<[u8; 3]>,
}

impl Image {
    /// A picture of one colour; a side of 0 becomes 1.
    pub fn filled(width: u32, height: u32, colour: [u8; 3]) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        Self { width, height, pixels: vec![colour; width as usize * height as usize] }
    }

    /// Mixes `colour` into the pixel by `alpha`, 0 to 1; outside the picture nothing happens.
    pub(crate) fn blend(&mut self, x: i64, y: i64, colour: [u8; 3], alpha: f32) {
        if x < 0 || y < 0 || x >= i64::from(self.width) || y >= i64::from(self.height) {
            return;
        }
        let pixel = &mut self.pixels[y as usize * self.width as usize + x as usize];
        let alpha = alpha.clamp(0.0, 1.0);
        for (old, new) in pixel.iter_mut().zip(colour) {
            *old = (f32::from(*old) + (f32::from(new) - f32::from(*old)) * alpha).round() as u8;
        }
    }
}

/// Writes `image` as a PNG file.
pub fn save_png(image: &Image, path: &Path) -> Result<(), DrawError> {
    let write = |source| DrawError::Write { path: path.into(), source };
    let encode = |source| DrawError::Encode { path: path.into(), source };
    let file = File::create(path).map_err(write)?;
    let mut encoder = png::Encoder::new(BufWriter::new(file), image.width, image.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().map_err(encode)?;
    writer.write_image_data(image.pixels.as_flattened()).map_err(encode)?;
    writer.finish().map_err(encode)
}
