//! The decoder of a GeoTIFF, its compressions, and the texts of its tags.

use super::ReadGeoTiffError;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use tiff::decoder::Decoder;
use tiff::decoder::ifd::Value;
use tiff::tags::{CompressionMethod, Tag};

pub(super) type Image = Decoder<BufReader<File>>;

pub(super) const NOT_COMPRESSED: u16 = CompressionMethod::None.to_u16();
pub(super) const PACK_BITS: u16 = CompressionMethod::PackBits.to_u16();

/// The text of a tag, of at most `longest` bytes.
pub(super) fn text(
    path: &Path,
    image: &mut Image,
    tag: Tag,
    name: &'static str,
    longest: u64,
) -> Result<Option<String>, ReadGeoTiffError> {
    let undecoded = |source| ReadGeoTiffError::Decode { path: path.to_owned(), source };
    // For a damaged file, the decoder would take too much memory and print to stderr.
    if image.image_ifd().find_entry(tag).is_some_and(|entry| entry.count() > longest) {
        let problem = format!("is longer than {longest} bytes");
        return Err(ReadGeoTiffError::Tag { path: path.to_owned(), tag: name, problem });
    }
    let found = image.find_tag(tag).map_err(undecoded)?;
    found.map(Value::into_string).transpose().map_err(undecoded)
}
