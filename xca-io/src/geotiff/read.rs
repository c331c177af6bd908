//! The reader of GeoTIFF, one strip or tile at a time.

use super::image::{Image, NOT_COMPRESSED, PACK_BITS, text};
use super::place::{Georeference, Pixels};
use super::{GeoKeys, ReadGeoTiffError, directory, meaning};
use crate::deflate;
use crate::placement::Placement;
use crate::quantity::Quantity;
use crate::raster::{Raster, are_huge, from_the_south};
use crate::regular_file;
use std::io::BufReader;
use std::path::Path;
use std::sync::Arc;
use tiff::TiffError;
use tiff::decoder::ifd::Value;
use tiff::decoder::{ChunkType, Decoder, DecodingResult, Limits};
use tiff::tags::{CompressionMethod, PhotometricInterpretation, PlanarConfiguration, Tag};

/// The largest strip or tile that is decoded, in bytes.
const LARGEST_CHUNK: usize = 1 << 30;

/// The longest list of strips or tiles, in bytes.
const LONGEST_LIST: usize = 1 << 26;

/// The memory that one or two tags may take even in a short file, in bytes.
const SHORT: usize = 1 << 20;

/// The number of cells that any file may leave out.
const FEW: usize = 1 << 20;

/// The largest growth of a strip or tile when it is expanded, by the code of its compression.
fn most_growth(compression: u16) -> u64 {
    match compression {
        NOT_COMPRESSED => 1,
        // A code of 12 bits stands for at most 4096 bytes.
        LZW => 2731,
        // Two bytes become 128.
        PACK_BITS => 64,
        _ => deflate::MOST_GROWTH,
    }
}

const LZW: u16 = CompressionMethod::LZW.to_u16();

pub(super) fn read(
    path: &Path,
    on: Option<Placement>,
    quantity: Quantity,
) -> Result<Raster, ReadGeoTiffError> {
    let unread = |source| ReadGeoTiffError::Open { path: path.to_owned(), source };
    let mut file = BufReader::with_capacity(1 << 16, regular_file::open(path).map_err(unread)?);
    let bytes = file.get_ref().metadata().map_err(unread)?.len();
    if !directory::fits(&mut file, bytes).map_err(unread)? {
        return Err(ReadGeoTiffError::Tag {
            path: path.to_owned(),
            tag: "of a list",
            problem: "claims more values than the file has bytes".to_owned(),
        });
    }
    let undecoded = |source| ReadGeoTiffError::Decode { path: path.to_owned(), source };
    let most = usize::try_from(bytes).unwrap_or(usize::MAX);
    // The header of a damaged file can claim any size. Uncompressed data is never longer than the file.
    let mut limits = Limits::default();
    limits.decoding_buffer_size = most.saturating_mul(size_of::<Value>()).saturating_add(SHORT);
    limits.intermediate_buffer_size = most.min(LARGEST_CHUNK);
    limits.ifd_value_size = most.saturating_add(SHORT).min(LONGEST_LIST);
    let mut image = Decoder::new(file).map_err(undecoded)?.with_limits(limits);
    let (columns, rows) = image.dimensions().map_err(undecoded)?;
    let extents = [columns as usize, rows as usize];
    let keys = keys(path, &mut image)?;
    meaning::check(path, &mut image, keys.as_ref(), quantity)?;
    let georeference = georeference(&mut image).map_err(undecoded)?;
    let Pixels { placement, from_the_south: is_upside_down } =
        match georeference.pixels(path, extents, keys.as_ref())? {
            Some(pixels) => pixels,
            None => Pixels { placement: placed_on(path, extents, on)?, from_the_south: false },
        };
    let nothing = nodata(path, &mut image)?;
    let band = Band::new(path, &mut image, extents, bytes)?;
    let mut limits = Limits::default();
    limits.decoding_buffer_size = LARGEST_CHUNK;
    limits.intermediate_buffer_size = most.min(LARGEST_CHUNK);
    let mut image = image.with_limits(limits);
    let mut values = band.values(path, &mut image, nothing)?;
    if let Some(cell) = values.iter().position(|value| value.is_infinite()) {
        // Here the rows are still in the order of the file.
        let [column, row] = [cell % extents[0], cell / extents[0]];
        let north = if is_upside_down { extents[1] - row } else { row + 1 };
        let (path, place) = (path.to_owned(), [column + 1, north]);
        return Err(ReadGeoTiffError::Infinite { path, place, value: values[cell] });
    }
    if !is_upside_down {
        values = from_the_south(values, extents[0]);
    }
    let coordinate_system = keys.filter(GeoKeys::is_named).map(Arc::new);
    Ok(Raster { placement, values, coordinate_system })
}

/// The place of an image without georeference.
fn placed_on(path: &Path, found: [usize; 2], on: Option<Placement>) -> Result<Placement, ReadGeoTiffError> {
    let path = path.to_owned();
    match on {
        None => Err(ReadGeoTiffError::NoPlace { path }),
        Some(on) if on.extents != found => Err(ReadGeoTiffError::Cells { path, found, wanted: on.extents }),
        Some(on) => Ok(on),
    }
}

fn numbers(image: &mut Image, tag: Tag) -> Result<Vec<f64>, TiffError> {
    image.find_tag(tag)?.map_or_else(|| Ok(Vec::new()), Value::into_f64_vec)
}

fn georeference(image: &mut Image) -> Result<Georeference, TiffError> {
    Ok(Georeference {
        scale: numbers(image, Tag::ModelPixelScaleTag)?,
        tiepoint: numbers(image, Tag::ModelTiepointTag)?,
        transformation: numbers(image, Tag::ModelTransformationTag)?,
    })
}

fn keys(path: &Path, image: &mut Image) -> Result<Option<GeoKeys>, ReadGeoTiffError> {
    let undecoded = |source| ReadGeoTiffError::Decode { path: path.to_owned(), source };
    let Some(directory) = image.find_tag(Tag::GeoKeyDirectoryTag).map_err(undecoded)? else {
        return Ok(None);
    };
    let directory = directory.into_u16_vec().map_err(undecoded)?;
    let doubles = numbers(image, Tag::GeoDoubleParamsTag).map_err(undecoded)?;
    let tag = Tag::GeoAsciiParamsTag;
    let text = text(path, image, tag, "GeoAsciiParams", LONGEST_TEXT)?.unwrap_or_default();
    let broken = || ReadGeoTiffError::Tag {
        path: path.to_owned(),
        tag: "GeoKeyDirectory",
        problem: "is shorter than its header says".to_owned(),
    };
    GeoKeys::new(directory, doubles, &text).ok_or_else(broken).map(Some)
}

/// The longest text of a tag, in bytes.
const LONGEST_TEXT: u64 = 1 << 16;

/// The NODATA value.
fn nodata(path: &Path, image: &mut Image) -> Result<Option<f64>, ReadGeoTiffError> {
    let Some(text) = text(path, image, Tag::GdalNodata, "GDAL_NODATA", LONGEST_TEXT)? else {
        return Ok(None);
    };
    let text = text.trim_matches(|letter: char| letter == '\0' || letter.is_whitespace());
    let wrong = || ReadGeoTiffError::Tag {
        path: path.to_owned(),
        tag: "GDAL_NODATA",
        problem: format!("is not a number but `{}`", text.escape_debug().take(40).collect::<String>()),
    };
    text.parse().map(Some).map_err(|_| wrong())
}

/// The storage of the first band.
struct Band {
    extents: [usize; 2],
    /// Columns and rows of a strip or tile.
    chunk: [usize; 2],
    /// The distance from one sample of the band to the next.
    stride: usize,
    /// The size of a pixel in a strip or tile, in bytes.
    pixel: u64,
    /// The length of each strip or tile in the file, in bytes. 0 if it was never written.
    lengths: Vec<u64>,
    /// The length of the file in bytes.
    bytes: u64,
    /// The largest growth when it is expanded.
    growth: u64,
}

impl Band {
    fn new(
        path: &Path,
        image: &mut Image,
        extents: [usize; 2],
        bytes: u64,
    ) -> Result<Self, ReadGeoTiffError> {
        let undecoded = |source| ReadGeoTiffError::Decode { path: path.to_owned(), source };
        let other = |found: String| ReadGeoTiffError::Samples { path: path.to_owned(), found };
        let colours = image.colortype().map_err(undecoded)?;
        if ![8, 16, 32, 64].contains(&colours.bit_depth()) {
            return Err(other(format!("samples of {} bits", colours.bit_depth())));
        }
        let unsigned = |image: &mut Image, tag| image.find_tag_unsigned::<u16>(tag).map_err(undecoded);
        let shade = unsigned(image, Tag::PhotometricInterpretation)?;
        if shade == Some(PhotometricInterpretation::WhiteIsZero.to_u16()) {
            return Err(other("white as 0".to_owned()));
        }
        let planes = unsigned(image, Tag::PlanarConfiguration)?;
        let is_planar = planes == Some(PlanarConfiguration::Planar.to_u16());
        let stride = if is_planar { 1 } else { usize::from(colours.num_samples()) };
        let lengths = match image.get_chunk_type() {
            ChunkType::Strip => Tag::StripByteCounts,
            ChunkType::Tile => Tag::TileByteCounts,
        };
        let lengths = image.find_tag_unsigned_vec(lengths).map_err(undecoded)?.unwrap_or_default();
        let (width, height) = image.chunk_dimensions();
        let chunk = [(width as usize).max(1), (height as usize).max(1)];
        let compression = unsigned(image, Tag::Compression)?.unwrap_or(NOT_COMPRESSED);
        let (pixel, growth) = (stride as u64 * u64::from(colours.bit_depth() / 8), most_growth(compression));
        Ok(Self { extents, chunk, stride, pixel, lengths, bytes, growth })
    }

    /// Whether the file can hold a strip or tile with this many pixels.
    fn can_hold(&self, index: u32, pixels: usize) -> bool {
        let stored = self.lengths.get(index as usize).map_or(0, |length| (*length).min(self.bytes));
        stored.saturating_mul(self.growth) >= (pixels as u64).saturating_mul(self.pixel)
    }

    /// Whether the file may leave out this many cells. A short file may not claim a large raster.
    fn may_leave_out(&self, cells: usize) -> bool {
        cells <= FEW || cells as u64 <= self.bytes.saturating_mul(deflate::MOST_GROWTH)
    }

    /// Reads all values in the order of the file. NODATA is NaN.
    fn values(
        &self,
        path: &Path,
        image: &mut Image,
        nothing: Option<f64>,
    ) -> Result<Vec<f64>, ReadGeoTiffError> {
        let [columns, rows] = self.extents;
        let too_large = || ReadGeoTiffError::Size { path: path.to_owned(), extents: self.extents };
        let mut values = Vec::new();
        let (mut index, mut left_out) = (0, 0_usize);
        let too_short = || ReadGeoTiffError::Tag {
            path: path.to_owned(),
            tag: "StripByteCounts or TileByteCounts",
            problem: "claims fewer bytes than the samples take".to_owned(),
        };
        // Allocate as decoding goes on: the header of a damaged file can claim any size.
        for first_row in (0..rows).step_by(self.chunk[1]) {
            let height = self.chunk[1].min(rows - first_row);
            let more = columns.checked_mul(height).ok_or_else(too_large)?;
            let begin = values.len();
            for first_column in (0..columns).step_by(self.chunk[0]) {
                let width = self.chunk[0].min(columns - first_column);
                let samples =
                    match self.lengths.get(index as usize) {
                        Some(0) => {
                            left_out = left_out.saturating_add(width.saturating_mul(height));
                            if !self.may_leave_out(left_out) {
                                return Err(too_large());
                            }
                            None
                        }
                        _ => {
                            let (across, down) = image.chunk_data_dimensions(index);
                            if !self.can_hold(index, (across as usize).saturating_mul(down as usize)) {
                                return Err(too_short());
                            }
                            let samples = image.read_chunk(index);
                            Some(samples.map_err(|source| ReadGeoTiffError::Decode {
                                path: path.to_owned(),
                                source,
                            })?)
                        }
                    };
                if first_column == 0 {
                    values.try_reserve(more).map_err(|_| too_large())?;
                    values.resize(begin + more, f64::NAN);
                }
                let target = &mut values[begin + first_column..];
                match samples {
                    None => fill(target, columns, [width, height], nothing.map_or(0.0, |_| f64::NAN)),
                    Some(samples) => {
                        Samples::new(samples, nothing).place(target, columns, [width, height], self.stride);
                    }
                }
                index += 1;
            }
        }
        Ok(values)
    }
}

/// Fills the cells of a strip or tile that the file leaves out.
fn fill(target: &mut [f64], columns: usize, [width, height]: [usize; 2], value: f64) {
    for row in target.chunks_mut(columns).take(height) {
        row.iter_mut().take(width).for_each(|own| *own = value);
    }
}

/// The samples of a strip or tile.
struct Samples {
    values: Vec<f64>,
}

impl Samples {
    fn new(samples: DecodingResult, nothing: Option<f64>) -> Self {
        let is_f32 = matches!(samples, DecodingResult::F32(_) | DecodingResult::F16(_));
        let mut values: Vec<f64> = match samples {
            DecodingResult::U8(samples) => samples.into_iter().map(f64::from).collect(),
            DecodingResult::U16(samples) => samples.into_iter().map(f64::from).collect(),
            DecodingResult::U32(samples) => samples.into_iter().map(f64::from).collect(),
            DecodingResult::U64(samples) => samples.into_iter().map(|sample| sample as f64).collect(),
            DecodingResult::I8(samples) => samples.into_iter().map(f64::from).collect(),
            DecodingResult::I16(samples) => samples.into_iter().map(f64::from).collect(),
            DecodingResult::I32(samples) => samples.into_iter().map(f64::from).collect(),
            DecodingResult::I64(samples) => samples.into_iter().map(|sample| sample as f64).collect(),
            DecodingResult::F16(samples) => samples.into_iter().map(f64::from).collect(),
            DecodingResult::F32(samples) => samples.into_iter().map(f64::from).collect(),
            DecodingResult::F64(samples) => samples,
        };
        if let Some(nothing) = nothing {
            values
                .iter_mut()
                .filter(|value| is_nodata(**value, nothing, is_f32))
                .for_each(|value| *value = f64::NAN);
        }
        Self { values }
    }

    /// Copies the first band into the rows of an image.
    fn place(&self, target: &mut [f64], columns: usize, [width, height]: [usize; 2], stride: usize) {
        let rows = target.chunks_mut(columns).zip(self.values.chunks(width * stride));
        for (row, samples) in rows.take(height) {
            row.iter_mut().zip(samples.iter().step_by(stride)).for_each(|(own, sample)| *own = *sample);
        }
    }
}

/// Whether a value is NODATA. The tag may have more digits than a sample, or fewer if it is huge.
fn is_nodata(value: f64, nothing: f64, is_f32: bool) -> bool {
    value == nothing || (is_f32 && value as f32 == nothing as f32) || are_huge(value, nothing)
}
