//! Animated GIF files.

use super::film::{Film, Part};
use super::palette::Histogram;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};
use xca_io::atomic::{WriteError, write_atomically};

/// Writes an animated GIF of pictures in PNG files. It plays in an endless loop. All pictures must have the
/// size of the first, in RGB with 8 bits.
///
/// All pictures share one palette. Up to 256 colours stay exact. Otherwise the palette has the most frequent
/// colours, and others close to the rest. A colour looks the same in all pictures, and there is no dithering.
/// Areas that do not change therefore do not flicker.
///
/// # Errors
/// [`WriteError::File`] with the path of the animation, if it cannot be written or a picture cannot be read.
pub fn write_gif(path: &Path, pictures: &[PathBuf], pictures_a_second: u16) -> Result<(), WriteError> {
    write_atomically(path, |file| {
        let film = Film::new(pictures)?;
        let mut histogram = Histogram::default();
        film.each_part(|part| {
            histogram.add(part.rgb);
            Ok(())
        })?;
        let palette = histogram.palette();
        let [width, height] = film.size();
        let mut encoder =
            Encoder::new(file, size(width)?, size(height)?, palette.rgb()).map_err(io::Error::other)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
        let mut shown = 0;
        film.each_part(|Part { at: [x, y], size: [width, height], rgb }| {
            let frame = Frame {
                delay: delay(shown, pictures_a_second),
                dispose: DisposalMethod::Keep,
                left: size(x)?,
                top: size(y)?,
                width: size(width)?,
                height: size(height)?,
                buffer: Cow::Owned(palette.indices(rgb)),
                ..Frame::default()
            };
            shown += 1;
            encoder.write_frame(&frame).map_err(io::Error::other)
        })
    })
}

/// The time for which a picture is shown, in whole hundredths of a second. Rounding errors do not add up.
fn delay(picture: u64, pictures_a_second: u16) -> u16 {
    let rate = u64::from(pictures_a_second.max(1));
    let end = |pictures: u64| (200 * pictures + rate) / (2 * rate);
    u16::try_from(end(picture + 1) - end(picture)).unwrap_or(u16::MAX)
}

fn size(pixels: usize) -> io::Result<u16> {
    u16::try_from(pixels).map_err(io::Error::other)
}
