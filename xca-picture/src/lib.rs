//! Pictures of a state as PNG files, without a display.
//!
//! | type | shows |
//! |---|---|
//! | [`ParticlePicture`] | particles as shaded spheres in their box, z up, coloured by a scalar |
//! | [`SlicePicture`] | one layer of a dense substate, one colour per cell: squares or hexagons |
//! | [`LandscapePicture`] | one layer of a dense substate over the relief of the ground, in 3D |
//! | [`BlockPicture`] | all layers of a dense substate, as cubes |
//! | [`PanelPicture`] | several of these side by side |
//! | [`animation`] | animations of pictures |
//!
//! Fill in the fields, render to a [`Picture`], and write:
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let temporary = tempfile::tempdir()?;
//! # let out = temporary.path();
//! use xca_picture::{Domain, ParticlePicture, Scalar};
//!
//! let positions = [[0.01, 0.01, 0.001], [0.03, 0.02, 0.001]];
//! let domain = Domain { lower: [0.0; 3], upper: [0.04; 3] };
//! let mut picture = ParticlePicture::new(&positions, 0.001, domain);
//! picture.size = [400, 300];
//! picture.title = "Two particles";
//! picture.colour = Some(Scalar::new("speed (m s^-1)", &[0.0, 0.5]));
//! picture.render()?.write(&out.join("two.png"))?;
//! # Ok(())
//! # }
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

pub mod animation;
mod averaging;
mod axes;
mod block;
mod canvas;
mod category;
mod colour;
mod depth;
mod eye;
mod landscape;
mod legend;
mod light;
mod mosaic;
mod panels;
mod particles;
mod relief;
mod scene;
mod slice;
mod text;
mod ticks;
mod view;

use std::io::BufReader;
use std::path::Path;

use xca_io::atomic::{WriteError, write_atomically};
use xca_io::regular_file;

pub use averaging::fitted;
pub use axes::Axes;
pub use block::BlockPicture;
pub use category::Category;
pub use colour::ColourMap;
pub use colour::encode;
pub use depth::{DepthBuffer, Disc};
pub use landscape::LandscapePicture;
pub use legend::Scalar;
pub use legend::Scale;
pub use mosaic::{Mosaic, Palette};
pub use panels::PanelPicture;
pub use particles::{Domain, ParticlePicture};
pub use relief::Relief;
pub use slice::SlicePicture;
pub use view::Viewpoint;
pub use xca_io::lattice::Lattice;

/// Data that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The number of values is not that of the particles or cells.
    #[error("cannot draw `{name}`: {found} values for {expected} {of}")]
    Length {
        /// The name of the scalar.
        name: String,
        /// The number of values.
        found: usize,
        /// The number of particles or cells.
        expected: usize,
        /// `particles` or `cells`.
        of: &'static str,
    },
    /// The box, the radius or the viewpoint is not valid. Corners and angles must be finite, the upper corner
    /// above the lower one, and the radius positive.
    #[error("cannot draw particles: {what} is {value}")]
    Geometry {
        /// The name of the quantity.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A size outside 200 to 8192 pixels.
    #[error("cannot draw a picture of {} by {} pixels: both must be from 200 to 8192", size[0], size[1])]
    Size {
        /// The requested size.
        size: [usize; 2],
    },
    /// A slice without cells.
    #[error("cannot draw a slice of {columns} by {rows} cells")]
    NoCells {
        /// The number of cells along x.
        columns: usize,
        /// The number of cells along y.
        rows: usize,
    },
}

/// A finished picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    width: usize,
    height: usize,
    rgb: Vec<u8>,
}

impl Picture {
    /// A picture of sRGB pixels, row by row from the top left, three bytes each.
    pub(crate) fn new(width: usize, height: usize, rgb: Vec<u8>) -> Self {
        Self { width, height, rgb }
    }

    /// The width in pixels.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// The height in pixels.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The pixels, row by row from the top left: red, green and blue in sRGB.
    #[must_use]
    pub fn rgb(&self) -> &[u8] {
        &self.rgb
    }

    /// Red, green and blue of the pixel in column `x` and row `y`, counted from the top left. Black outside
    /// the picture.
    #[must_use]
    pub fn pixel(&self, x: usize, y: usize) -> [u8; 3] {
        let at = 3 * (y * self.width + x);
        match self.rgb.get(at..at + 3) {
            Some(&[r, g, b]) if x < self.width => [r, g, b],
            _ => [0; 3],
        }
    }

    /// Writes the picture to `path` as PNG. The file appears complete or not at all.
    ///
    /// # Errors
    /// [`WriteError::File`] with the path.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        write_atomically(path, |file| {
            let size = |n: usize| u32::try_from(n).map_err(std::io::Error::other);
            let mut encoder = png::Encoder::new(file, size(self.width)?, size(self.height)?);
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_depth(png::BitDepth::Eight);
            encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
            encoder.add_text_chunk(SOFTWARE.to_owned(), XCA.to_owned())?;
            let mut writer = encoder.write_header()?;
            writer.write_image_data(&self.rgb)?;
            Ok(writer.finish()?)
        })
    }
}

/// The key in a PNG file that names the program.
const SOFTWARE: &str = "Software";
const XCA: &str = "xca";

/// Whether [`Picture::write`] has written a file.
#[must_use]
pub fn is_picture_of_xca(path: &Path) -> bool {
    let Ok(file) = regular_file::open(path) else { return false };
    let Ok(reader) = png::Decoder::new(BufReader::new(file)).read_info() else { return false };
    let texts = &reader.info().uncompressed_latin1_text;
    texts.iter().any(|text| text.keyword == SOFTWARE && text.text == XCA)
}

fn check_size(size: [usize; 2]) -> Result<(), PictureError> {
    if size.iter().all(|n| (200..=8192).contains(n)) { Ok(()) } else { Err(PictureError::Size { size }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::File;

    #[test]
    fn a_png_decodes_to_the_same_pixels() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.png");
        let rgb: Vec<u8> = (0..7 * 5 * 3).map(|i| (i * 37 % 256) as u8).collect();
        let picture = Picture { width: 7, height: 5, rgb };
        picture.write(&path).unwrap();
        let decoder = png::Decoder::new(BufReader::new(File::open(&path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        assert_eq!((reader.info().width, reader.info().height), (7, 5));
        assert_eq!(reader.info().color_type, png::ColorType::Rgb);
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        assert_eq!(bytes, picture.rgb());
        assert_eq!(picture.pixel(6, 4), [picture.rgb[102], picture.rgb[103], picture.rgb[104]]);
        assert_eq!(picture.pixel(7, 0), [0; 3]);
        assert_eq!(picture.pixel(0, 5), [0; 3]);
    }

    #[test]
    fn a_png_that_cannot_be_written_names_its_path() {
        let picture = Picture { width: 1, height: 1, rgb: vec![0; 3] };
        let error = picture.write(Path::new("/nowhere/p.png")).unwrap_err();
        assert!(error.to_string().contains("/nowhere/p.png"), "{error}");
    }
}
