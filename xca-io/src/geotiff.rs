//! GeoTIFF (`.tif`): a layer of cells, its place on the map and its coordinate system.
//!
//! The reader takes the first band of the first image. Samples are integers of 8 to 64 bits, `f32` or `f64`,
//! in strips or tiles. They are uncompressed, or compressed with Deflate, LZW or PackBits; Deflate and LZW
//! with any predictor. Rows of a file begin in the north, those of a [`Raster`] in the south.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let temporary = tempfile::tempdir()?;
//! # let path = temporary.path().join("depth.tif");
//! use xca_io::geotiff::{self, SampleType};
//! use xca_io::raster::Raster;
//!
//! let depth = Raster::new([2, 1], 10.0, vec![0.5, f64::NAN]).ok_or("one value for each cell")?;
//! geotiff::write(&path, &depth.with_corner([2600.0, 5100.0]), SampleType::F32)?;
//! assert_eq!(geotiff::read(&path)?.value([0, 0]), Some(0.5));
//! # Ok(())
//! # }
//! ```

mod directory;
mod error;
mod image;
mod keys;
mod meaning;
mod place;
mod read;
mod write;

pub use error::ReadGeoTiffError;
pub use keys::GeoKeys;
pub use write::SampleType;

use crate::atomic::WriteError;
use crate::placement::Placement;
use crate::quantity::Quantity;
use crate::raster::Raster;
use crate::regular_file;
use std::io::Read;
use std::path::Path;

/// Reads the first band of a GeoTIFF.
///
/// NODATA is NaN, and the value of GDAL's tag 42113. If the pixels are points (`PixelIsPoint`), the cells are
/// centred on these points.
///
/// # Errors
/// [`ReadGeoTiffError`] with the path.
pub fn read(path: &Path) -> Result<Raster, ReadGeoTiffError> {
    read::read(path, None, Quantity::Any)
}

/// Like [`read`], but a file without georeference lies at `on`, if its columns and rows agree.
pub(crate) fn read_placed(
    path: &Path,
    on: Option<Placement>,
    quantity: Quantity,
) -> Result<Raster, ReadGeoTiffError> {
    read::read(path, on, quantity)
}

/// Writes a raster as a GeoTIFF with one band and Deflate compression. NODATA is NaN. The file appears
/// complete or not at all.
///
/// # Errors
/// [`WriteError`] with the path.
pub fn write(path: &Path, raster: &Raster, samples: SampleType) -> Result<(), WriteError> {
    write::write(path, raster, samples)
}

/// Whether a file is a TIFF by its first bytes or its extension.
pub(crate) fn is_geotiff(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    let mut begin = [0; 4];
    let has_begin =
        regular_file::open(path).and_then(|mut file| file.read_exact(&mut begin)).is_ok() && is_magic(begin);
    has_begin || ["tif", "tiff"].iter().any(|known| extension.eq_ignore_ascii_case(known))
}

/// Whether the bytes begin a TIFF or BigTIFF, little-endian or big-endian.
fn is_magic(begin: [u8; 4]) -> bool {
    matches!(&begin, b"II\x2a\0" | b"MM\0\x2a" | b"II\x2b\0" | b"MM\0\x2b")
}

#[cfg(test)]
mod tests;
