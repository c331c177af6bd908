//! Animated PNG files (APNG). Browsers play them; every other program shows the first picture.

use super::film::{Film, Part};
use std::io;
use std::path::{Path, PathBuf};
use xca_io::atomic::{WriteError, write_atomically};

/// Writes an animated PNG of pictures in PNG files. It plays in an endless loop. All pictures must have the
/// size of the first, in RGB with 8 bits.
///
/// The file stores only the changes from one picture to the next.
///
/// # Errors
/// [`WriteError::File`] with the path of the animation, if it cannot be written or a picture cannot be read.
pub fn write_apng(path: &Path, pictures: &[PathBuf], pictures_a_second: u16) -> Result<(), WriteError> {
    write_atomically(path, |file| {
        let film = Film::new(pictures)?;
        let [width, height] = film.size();
        let count = u32::try_from(pictures.len()).map_err(io::Error::other)?;
        let mut encoder = png::Encoder::new(file, size(width)?, size(height)?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_animated(count, 0)?;
        encoder.set_frame_delay(1, pictures_a_second)?;
        let mut writer = encoder.write_header()?;
        film.each_part(|Part { at: [x, y], size: [width, height], rgb }| {
            writer.reset_frame_position()?;
            writer.set_frame_dimension(size(width)?, size(height)?)?;
            writer.set_frame_position(size(x)?, size(y)?)?;
            Ok(writer.write_image_data(rgb)?)
        })?;
        Ok(writer.finish()?)
    })
}

fn size(pixels: usize) -> io::Result<u32> {
    u32::try_from(pixels).map_err(io::Error::other)
}
