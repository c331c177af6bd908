//! The writer of GeoTIFF.

use super::GeoKeys;
use crate::atomic::{WriteError, write_atomically};
use crate::placement::Placement;
use crate::raster::{Raster, from_the_south};
use std::io::{self, Seek, Write};
use std::path::Path;
use tiff::encoder::colortype::{ColorType, Gray32Float, Gray64Float};
use tiff::encoder::compression::DeflateLevel;
use tiff::encoder::{Compression, TiffEncoder, TiffKind, TiffValue};
use tiff::tags::Tag;
use tiff::{TiffError, TiffResult};

/// The sample type of a GeoTIFF.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SampleType {
    /// 32 bits: values are rounded to `f32`.
    F32,
    /// 64 bits: values keep all their bits.
    F64,
}

impl SampleType {
    fn bytes(self) -> usize {
        match self {
            Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// The largest TIFF, in bytes of samples. A larger file is a BigTIFF, with offsets of 64 bits.
const LARGEST_TIFF: usize = 4_000_000_000;

pub(super) fn write(path: &Path, raster: &Raster, samples: SampleType) -> Result<(), WriteError> {
    let is_big = raster.values.len().saturating_mul(samples.bytes()) > LARGEST_TIFF;
    write_atomically(path, |file| {
        let written = if is_big {
            TiffEncoder::new_big(file).and_then(|encoder| write_image(encoder, raster, samples))
        } else {
            TiffEncoder::new(file).and_then(|encoder| write_image(encoder, raster, samples))
        };
        written.map_err(as_io)
    })
}

fn as_io(error: TiffError) -> io::Error {
    match error {
        TiffError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

fn write_image<W: Write + Seek, K: TiffKind>(
    encoder: TiffEncoder<W, K>,
    raster: &Raster,
    samples: SampleType,
) -> TiffResult<()> {
    let values = from_the_south(raster.values.clone(), raster.placement.extents[0]);
    match samples {
        SampleType::F32 => {
            let values: Vec<f32> = values.into_iter().map(|value| value as f32).collect();
            write_samples::<Gray32Float, _, _>(encoder, raster, &values)
        }
        SampleType::F64 => write_samples::<Gray64Float, _, _>(encoder, raster, &values),
    }
}

fn write_samples<C: ColorType, W: Write + Seek, K: TiffKind>(
    encoder: TiffEncoder<W, K>,
    raster: &Raster,
    samples: &[C::Inner],
) -> TiffResult<()>
where
    [C::Inner]: TiffValue,
{
    let Placement { extents, corner: [west, south], side } = raster.placement;
    let [columns, rows] = extents.map(u32::try_from);
    let mut encoder = encoder.with_compression(Compression::Deflate(DeflateLevel::Balanced));
    let mut image = encoder.new_image::<C>(columns?, rows?)?;
    let keys = raster.coordinate_system.as_deref();
    let north = south + side * extents[1] as f64;
    let shift = if keys.is_some_and(GeoKeys::pixel_is_point) { side / 2.0 } else { 0.0 };
    let tiepoint = [0.0, 0.0, 0.0, west + shift, north - shift, 0.0];
    let tags = image.encoder();
    tags.write_tag(Tag::ModelPixelScaleTag, &[side, side, 0.0][..])?;
    tags.write_tag(Tag::ModelTiepointTag, &tiepoint[..])?;
    if let Some(GeoKeys { directory, doubles, text }) = keys {
        tags.write_tag(Tag::GeoKeyDirectoryTag, &directory[..])?;
        if !doubles.is_empty() {
            tags.write_tag(Tag::GeoDoubleParamsTag, &doubles[..])?;
        }
        if !text.is_empty() {
            tags.write_tag(Tag::GeoAsciiParamsTag, &text[..])?;
        }
    }
    tags.write_tag(Tag::GdalNodata, "nan")?;
    image.write_data(samples)
}
