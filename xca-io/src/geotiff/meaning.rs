//! What the samples of a GeoTIFF mean, besides their place: files whose numbers are not what they seem are
//! refused.

use super::image::{Image, NOT_COMPRESSED, PACK_BITS, text};
use super::{GeoKeys, ReadGeoTiffError};
use crate::map_unit::MapUnit;
use crate::quantity::Quantity;
use std::path::Path;
use tiff::tags::Tag;

/// `GDAL_METADATA`: XML with an item for each property.
const METADATA: Tag = Tag::Unknown(42_112);

/// The longest `GDAL_METADATA`, in bytes.
const LONGEST_METADATA: u64 = 1 << 20;

/// Units of heights that GDAL takes for metres.
const METRES: [&str; 5] = ["", "m", "metre", "meter", "metres"];

/// Refuses samples in an order or an encoding that the decoder does not know, samples that stand for other
/// numbers, and heights in another unit than metres.
pub(super) fn check(
    path: &Path,
    image: &mut Image,
    keys: Option<&GeoKeys>,
    quantity: Quantity,
) -> Result<(), ReadGeoTiffError> {
    check_encoding(path, image)?;
    let metadata = text(path, image, METADATA, "GDAL_METADATA", LONGEST_METADATA)?.unwrap_or_default();
    for (role, neutral) in [("scale", 1.0), ("offset", 0.0)] {
        let Some(found) = property(&metadata, role) else { continue };
        if found.parse::<f64>().ok() != Some(neutral) {
            return Err(ReadGeoTiffError::Scaled { path: path.to_owned(), role, found: shortened(found) });
        }
    }
    let unit = property(&metadata, "unittype").filter(|unit| !METRES.contains(&unit.to_lowercase().as_str()));
    let unit = unit.map(shortened).or_else(|| {
        keys.map(GeoKeys::height_unit).filter(|unit| *unit != MapUnit::Metre).map(|unit| unit.to_string())
    });
    match unit {
        Some(unit) if quantity == Quantity::Height => {
            Err(ReadGeoTiffError::HeightUnit { path: path.to_owned(), unit })
        }
        _ => Ok(()),
    }
}

/// The decoder ignores the order of rows and of bits, and undoes a predictor where none is allowed.
fn check_encoding(path: &Path, image: &mut Image) -> Result<(), ReadGeoTiffError> {
    let mut value = |tag, default| {
        let found = image.find_tag_unsigned::<u16>(tag);
        let undecoded = |source| ReadGeoTiffError::Decode { path: path.to_owned(), source };
        found.map(|found| found.unwrap_or(default)).map_err(undecoded)
    };
    let compression = value(Tag::Compression, NOT_COMPRESSED)?;
    let is_predicted = value(Tag::Predictor, 1)? != 1;
    let other =
        |found: &str| Err(ReadGeoTiffError::Samples { path: path.to_owned(), found: found.to_owned() });
    if value(Tag::Orientation, 1)? != 1 {
        return other("rows that do not begin in the north-west (Orientation)");
    }
    if value(Tag::FillOrder, 1)? != 1 {
        return other("bits in reverse order (FillOrder)");
    }
    if is_predicted && [NOT_COMPRESSED, PACK_BITS].contains(&compression) {
        return other("a predictor without LZW or Deflate");
    }
    Ok(())
}

/// The text of a property of the first band, such as `scale`.
fn property<'a>(metadata: &'a str, role: &str) -> Option<&'a str> {
    let wanted = format!("role=\"{role}\"");
    metadata.split("<Item ").skip(1).find_map(|item| {
        let (attributes, rest) = item.split_once('>')?;
        let is_first = !attributes.contains("sample=") || attributes.contains("sample=\"0\"");
        let found = attributes.contains(&wanted) && is_first;
        found.then(|| rest.split_once('<').map_or(rest, |(text, _)| text).trim())
    })
}

fn shortened(text: &str) -> String {
    text.escape_debug().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::property;

    #[test]
    fn properties_of_the_first_band_are_found_by_their_role() {
        let metadata = "<GDALMetadata>\n  <Item name=\"AREA\">5</Item>\n  <Item name=\"SCALE\" sample=\"1\" \
                        role=\"scale\">7</Item>\n  <Item name=\"SCALE\" sample=\"0\" role=\"scale\"> 0.1 </Item>\n\
                        </GDALMetadata>\n";
        assert_eq!(property(metadata, "scale"), Some("0.1"));
        assert_eq!(property(metadata, "offset"), None);
        assert_eq!(property("<Item role=\"offset\">3", "offset"), Some("3"));
        assert_eq!(property("<Item role=\"offset\"", "offset"), None);
    }
}
