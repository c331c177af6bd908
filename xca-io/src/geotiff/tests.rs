use super::*;
use crate::map::Map;
use proptest::prelude::*;
use std::fs::{self, File};
use std::path::PathBuf;
use std::sync::Arc;
use tiff::encoder::{TiffEncoder, colortype};
use tiff::tags::Tag;

/// UTM zone 33N, with pixels that are points or areas.
fn utm(raster_type: u16) -> GeoKeys {
    let directory = vec![1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, raster_type, 3072, 0, 1, 32633];
    GeoKeys::new(directory, vec![0.5], "UTM|").unwrap()
}

fn slope() -> Raster {
    let values = vec![0.1 + 0.2, -0.0, f64::MAX, 5e-324, f64::NAN, -9999.0];
    Raster::new([3, 2], 10.0, values).unwrap().with_corner([2600.5, 5100.0])
}

fn bits(raster: &Raster) -> Vec<u64> {
    raster.values().iter().map(|value| value.to_bits()).collect()
}

/// Writes a file with these tags and the samples 1 to 6, the first in the north-west.
fn made(folder: &Path, tags: &[(Tag, &[f64])], nodata: Option<&str>) -> PathBuf {
    let texts: Vec<(Tag, &str)> = nodata.map(|text| (Tag::GdalNodata, text)).into_iter().collect();
    made_with(folder, tags, &texts, &[])
}

/// The same with tags that are texts or short numbers.
fn made_with(
    folder: &Path,
    tags: &[(Tag, &[f64])],
    texts: &[(Tag, &str)],
    numbers: &[(Tag, &[u16])],
) -> PathBuf {
    let path = folder.join("made.tif");
    let mut encoder = TiffEncoder::new(File::create(&path).unwrap()).unwrap();
    let mut image = encoder.new_image::<colortype::Gray8>(3, 2).unwrap();
    for (tag, numbers) in tags {
        image.encoder().write_tag(*tag, *numbers).unwrap();
    }
    for (tag, text) in texts {
        image.encoder().write_tag(*tag, *text).unwrap();
    }
    for (tag, numbers) in numbers {
        image.encoder().write_tag(*tag, *numbers).unwrap();
    }
    image.write_data(&[1, 2, 3, 4, 5, 6]).unwrap();
    path
}

const SCALE: (Tag, &[f64]) = (Tag::ModelPixelScaleTag, &[10.0, 10.0, 0.0]);
const TIEPOINT: (Tag, &[f64]) = (Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, 100.0, 220.0, 0.0]);

fn message(error: ReadGeoTiffError) -> String {
    let message = error.to_string();
    message[message.find("made.tif").unwrap()..].to_owned()
}

#[test]
fn every_bit_and_the_coordinate_system_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slope.tif");
    for raster_type in [1, 2] {
        let keys = Arc::new(utm(raster_type));
        let slope = slope().with_coordinate_system(Some(keys.clone()));
        write(&path, &slope, SampleType::F64).unwrap();
        let back = Raster::read(&path).unwrap();
        assert_eq!((bits(&back), back.placement()), (bits(&slope), slope.placement()));
        assert_eq!(back.coordinate_system(), Some(&keys));
        let map = Map::from(&back);
        assert_eq!(map.coordinate_system().and_then(|keys| keys.epsg()), Some(32633));
        assert_eq!(map.missing().unwrap(), [false, false, false, false, true, false]);
    }
    let plain = Raster::new([2, 1], 1.0, vec![0.1, -1.5]).unwrap();
    write(&path, &plain, SampleType::F32).unwrap();
    let back = read(&path).unwrap();
    assert_eq!((back.values(), back.coordinate_system()), (&[f64::from(0.1_f32), -1.5][..], None));
}

/// Names of coordinate systems should be ASCII, but not every file obeys. Such a file can be written again.
#[test]
fn names_that_are_not_ascii_are_written_with_as_many_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slope.tif");
    let keys = GeoKeys::new(utm(1).directory, Vec::new(), "Österreich|").unwrap();
    write(&path, &slope().with_coordinate_system(Some(Arc::new(keys))), SampleType::F64).unwrap();
    let back = read(&path).unwrap();
    assert_eq!(back.coordinate_system().unwrap().text, "??sterreich|");
}

#[test]
fn the_place_follows_from_the_tags() {
    let folder = tempfile::tempdir().unwrap();
    let corner = |tags: &[(Tag, &[f64])]| {
        let raster = read(&made(folder.path(), tags, None)).unwrap();
        assert_eq!((raster.side(), raster.value([0, 1]), raster.value([2, 0])), (10.0, Some(1.0), Some(6.0)));
        raster.corner()
    };
    assert_eq!(corner(&[SCALE, TIEPOINT]), [100.0, 200.0]);
    // The same place, with a tie point in the south-east.
    let tiepoint: &[f64] = &[3.0, 2.0, 0.0, 130.0, 200.0, 0.0];
    assert_eq!(corner(&[SCALE, (Tag::ModelTiepointTag, tiepoint)]), [100.0, 200.0]);
    let matrix = |side: f64, row: f64, y: f64, shear: f64| {
        [side, shear, 0.0, 100.0, 0.0, row, 0.0, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    };
    let transformed =
        |matrix: &[f64]| read(&made(folder.path(), &[(Tag::ModelTransformationTag, matrix)], None));
    assert_eq!(corner(&[(Tag::ModelTransformationTag, &matrix(10.0, -10.0, 220.0, 0.0))]), [100.0, 200.0]);
    // The first row is the southernmost one.
    let up = transformed(&matrix(10.0, 10.0, 200.0, 0.0)).unwrap();
    assert_eq!((up.corner(), up.value([0, 0]), up.value([2, 1])), ([100.0, 200.0], Some(1.0), Some(6.0)));
    let refused = |matrix: &[f64]| message(transformed(matrix).unwrap_err());
    assert!(refused(&matrix(10.0, -10.0, 220.0, 0.1)).starts_with("made.tif: the GeoTIFF is rotated"));
    assert!(refused(&matrix(10.0, -20.0, 220.0, 0.0)).contains("not square: 10 along x and 20 along y"));
    assert!(
        refused(&matrix(-10.0, -10.0, 220.0, 0.0)).contains("ModelTransformation of the GeoTIFF has a side")
    );
    assert!(refused(&matrix(10.0, -10.0, f64::NAN, 0.0)).contains("has a number that is not finite"));
    assert!(refused(&[1.0; 3]).contains("has 3 numbers, not 16"));
}

/// Where the standard and GDAL, or two tags, disagree, the place is in doubt.
#[test]
fn a_place_in_doubt_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |scale: &[f64], tiepoints: &[f64]| {
        let tags = [(Tag::ModelPixelScaleTag, scale), (Tag::ModelTiepointTag, tiepoints)];
        message(read(&made(folder.path(), &tags, None)).unwrap_err())
    };
    let south_up = refused(&[10.0, -10.0, 0.0], TIEPOINT.1);
    assert!(
        south_up.contains("ModelPixelScale of the GeoTIFF has a side that is not more than 0"),
        "{south_up}"
    );
    for other in [[3.0, 2.0, 0.0, 130.0, 210.0, 0.0], [3.0, 0.0, 0.0, 131.0, 220.0, 0.0]] {
        let said = refused(SCALE.1, &[TIEPOINT.1, &other].concat());
        assert!(said.contains("ModelTiepoint of the GeoTIFF has points that do not fit"), "{said}");
    }
    let far = refused(SCALE.1, &[0.0, 0.0, 0.0, 1e20, 220.0, 0.0]);
    assert!(far.contains("a coordinate of 1e20 is too large for cells with a side of 10"), "{far}");
    let two = [TIEPOINT.1, &[3.0, 2.0, 0.0, 130.0, 200.0, 0.0]].concat();
    let placed = read(&made(folder.path(), &[SCALE, (Tag::ModelTiepointTag, &two)], None)).unwrap();
    assert_eq!((placed.corner(), placed.side()), ([100.0, 200.0], 10.0));
}

/// What the decoder would read as other numbers, or in another order.
#[test]
fn samples_that_are_not_what_they_seem_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let read_with = |texts: &[(Tag, &str)], numbers: &[(Tag, &[u16])]| {
        Raster::read(&made_with(folder.path(), &[SCALE, TIEPOINT], texts, numbers))
    };
    let refused = |tag: Tag, number: u16| read_with(&[], &[(tag, &[number])]).unwrap_err().to_string();
    for orientation in [2, 3, 4, 8] {
        assert!(refused(Tag::Orientation, orientation).contains("do not begin in the north-west"));
    }
    assert!(refused(Tag::FillOrder, 2).contains("bits in reverse order"));
    assert!(refused(Tag::Predictor, 2).contains("a predictor without LZW or Deflate"));
    let plain = [(Tag::Orientation, &[1_u16][..]), (Tag::FillOrder, &[1]), (Tag::Predictor, &[1])];
    assert_eq!(read_with(&[], &plain).unwrap().value([0, 1]), Some(1.0));
    let scaled = |role: &str, text: &str| {
        let item = format!("<GDALMetadata><Item sample=\"0\" role=\"{role}\">{text}</Item></GDALMetadata>");
        read_with(&[(Tag::Unknown(42_112), &item)], &[]).map(|raster| raster.value([0, 1]))
    };
    for (role, text) in
        [("scale", "0.1"), ("offset", "100"), ("offset", "-1e3"), ("scale", "nan"), ("scale", "")]
    {
        let said = scaled(role, text).unwrap_err().to_string();
        assert!(
            said.contains(&format!("made.tif: the {role} of the samples of the GeoTIFF is {text}; ")),
            "{said}"
        );
    }
    assert_eq!(scaled("scale", "1.0").unwrap(), Some(1.0));
    assert_eq!(scaled("offset", "0").unwrap(), Some(1.0));
}

#[test]
fn heights_in_feet_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let with_unit = |code: u16| {
        let directory = [1, 1, 0, 4, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32633, 4099, 0, 1, code];
        made_with(folder.path(), &[SCALE, TIEPOINT], &[], &[(Tag::GeoKeyDirectoryTag, &directory)])
    };
    let with_text = |unit: &str| {
        let item =
            format!("<GDALMetadata><Item name=\"UNITTYPE\" role=\"unittype\">{unit}</Item></GDALMetadata>");
        made_with(folder.path(), &[SCALE, TIEPOINT], &[(Tag::Unknown(42_112), &item)], &[])
    };
    let refused = |path: &Path, unit: &str| {
        for error in [Raster::read_heights(path).unwrap_err(), Raster::read_thickness(path).unwrap_err()] {
            let said = error.to_string();
            assert!(
                said.contains(&format!("the heights of the GeoTIFF are in {unit}, but models")),
                "{said}"
            );
        }
        // The unit of any other number is its own affair.
        assert_eq!(Raster::read(path).unwrap().value([0, 0]), Some(4.0));
    };
    refused(&with_unit(9002), "feet");
    refused(&with_unit(9003), "US survey feet");
    refused(&with_unit(9096), "another unit than metres");
    refused(&with_text("ft"), "ft");
    refused(&with_text("US survey foot"), "US survey foot");
    for path in [with_unit(9001), with_text("m"), with_text("Metre"), with_text("")] {
        assert_eq!(Raster::read_heights(&path).unwrap().value([2, 0]), Some(6.0));
    }
}

#[test]
fn a_file_without_a_place_is_taken_where_the_cells_are_known() {
    let folder = tempfile::tempdir().unwrap();
    let path = made(folder.path(), &[], None);
    assert!(message(read(&path).unwrap_err()).contains("has no position; set its corners"));
    let placement = Placement { extents: [3, 2], corner: [7.0, 8.0], side: 2.0 };
    let raster = Raster::read_on(&path, placement).unwrap();
    assert_eq!((raster.placement(), raster.value([0, 0])), (placement, Some(4.0)));
    let said = Raster::read_on(&path, Placement { extents: [2, 3], ..placement }).unwrap_err().to_string();
    assert!(said.ends_with("it has 3 x 2 cells, not 2 x 3 as the model"), "{said}");
}

#[test]
fn nodata_is_what_the_tag_says() {
    let folder = tempfile::tempdir().unwrap();
    let holes = |text: &str| {
        let raster = read(&made(folder.path(), &[SCALE, TIEPOINT], Some(text)))?;
        Ok(raster.values().iter().map(|value| value.is_nan()).collect::<Vec<_>>())
    };
    assert_eq!(holes("5 ").map_err(message), Ok(vec![false, true, false, false, false, false]));
    assert_eq!(holes("-9999").map_err(message), Ok(vec![false; 6]));
    assert_eq!(
        holes("none").map_err(message),
        Err("made.tif: the tag GDAL_NODATA of the GeoTIFF is not a number but `none`".to_owned())
    );
    let long = "1".repeat(70_000);
    assert!(
        message(holes(&long).unwrap_err()).ends_with("GDAL_NODATA of the GeoTIFF is longer than 65536 bytes")
    );
}

/// The tag is decimal text. In `f32` it means the nearest `f32`, in `f64` exactly that number.
#[test]
fn nodata_among_f32_is_the_nearest_of_them() {
    const NODATA: f64 = -9999.9;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("made.tif");
    let (nearest, next) = (NODATA as f32, f32::from_bits((NODATA as f32).to_bits() + 1));
    assert!(f64::from(nearest) != NODATA);
    let holes = |is_f32: bool| {
        let mut encoder = TiffEncoder::new(File::create(&path).unwrap()).unwrap();
        let tags = [SCALE, TIEPOINT];
        if is_f32 {
            let mut image = encoder.new_image::<colortype::Gray32Float>(3, 1).unwrap();
            tags.iter().for_each(|(tag, numbers)| image.encoder().write_tag(*tag, *numbers).unwrap());
            image.encoder().write_tag(Tag::GdalNodata, "-9999.9").unwrap();
            image.write_data(&[nearest, next, 1.0]).unwrap();
        } else {
            let mut image = encoder.new_image::<colortype::Gray64Float>(3, 1).unwrap();
            tags.iter().for_each(|(tag, numbers)| image.encoder().write_tag(*tag, *numbers).unwrap());
            image.encoder().write_tag(Tag::GdalNodata, "-9999.9").unwrap();
            image.write_data(&[f64::from(nearest), NODATA, 1.0]).unwrap();
        }
        read(&path).unwrap().values().iter().map(|value| value.is_nan()).collect::<Vec<_>>()
    };
    assert_eq!(holes(true), [true, false, false]);
    assert_eq!(holes(false), [false, true, false]);
}

#[test]
fn layers_of_different_coordinate_systems_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let map = Map::from(&slope().with_coordinate_system(Some(Arc::new(utm(1)))));
    let layer = slope().with_coordinate_system(Some(Arc::new(GeoKeys::projected(32632))));
    let said = map.check(folder.path(), &layer, "dem.tif").unwrap_err().to_string();
    assert!(said.contains("does not lie on dem.tif: its coordinate system is EPSG:32632, not EPSG:32633"));
    // A layer without a coordinate system fits every map.
    assert!(map.check(folder.path(), &slope(), "dem.tif").is_ok());
}

#[test]
fn what_is_no_geotiff_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dem.tif");
    assert!(Raster::read(&path).unwrap_err().to_string().starts_with("cannot open the GeoTIFF"));
    fs::write(&path, "ncols 3\n").unwrap();
    assert!(Raster::read(&path).unwrap_err().to_string().starts_with("cannot read the GeoTIFF"));
    // The first bytes identify the format under any name.
    write(&path, &slope(), SampleType::F64).unwrap();
    let moved = folder.path().join("dem.asc");
    fs::rename(&path, &moved).unwrap();
    assert_eq!(bits(&Raster::read(&moved).unwrap()), bits(&slope()));
    let infinite = Raster::new([2, 2], 1.0, vec![0.0, 1.0, 2.0, f64::INFINITY]).unwrap();
    write(&path, &infinite, SampleType::F32).unwrap();
    let said = read(&path).unwrap_err().to_string();
    assert!(
        said.ends_with("dem.tif: inf in column 2, row 1 from the north is not a finite number"),
        "{said}"
    );
}

/// A header that claims 4 thousand million cells does not make the reader allocate them.
#[test]
fn memory_follows_what_is_decoded() {
    let folder = tempfile::tempdir().unwrap();
    let path = made(folder.path(), &[SCALE, TIEPOINT], None);
    let mut bytes = fs::read(&path).unwrap();
    // Width and length are entries of 12 bytes: tag, type, count, value.
    for tag in [256_u16, 257] {
        let entry = [tag.to_le_bytes(), 4_u16.to_le_bytes()].concat();
        let at = bytes.windows(4).position(|window| window == entry).unwrap() + 8;
        bytes[at..at + 4].copy_from_slice(&65_000_u32.to_le_bytes());
    }
    fs::write(&path, bytes).unwrap();
    assert!(matches!(read(&path), Err(ReadGeoTiffError::Tag { .. } | ReadGeoTiffError::Decode { .. })));
}

proptest! {
    /// Damaged files give errors or other rasters, never a panic.
    #[test]
    fn damaged_files_are_read_or_refused(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in any::<prop::sample::Index>(),
        is_cut in any::<bool>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.tif");
        write(&path, &slope().with_coordinate_system(Some(Arc::new(utm(1)))), SampleType::F32).unwrap();
        let mut bytes = fs::read(&path).unwrap();
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        if is_cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        fs::write(&path, bytes).unwrap();
        if let Ok(raster) = read(&path) {
            let [columns, rows] = raster.extents();
            prop_assert_eq!(raster.values().len(), columns * rows);
        }
    }
}
