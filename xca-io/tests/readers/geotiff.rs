//! GeoTIFF files of rasterio read here, and files of this crate read by rasterio.

use super::{are_same, number, run};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;
use xca_io::geotiff::{self, GeoKeys, SampleType};
use xca_io::raster::Raster;

/// The values that rasterio reads, from the south.
fn values(found: &Value) -> Vec<f64> {
    let columns = found["extents"][0].as_u64().unwrap() as usize;
    let values: Vec<f64> = found["values"].as_array().unwrap().iter().map(number).collect();
    values.chunks(columns).rev().flatten().copied().collect()
}

fn file_name(found: &Value) -> &str {
    found["name"].as_str().unwrap()
}

/// Checks a raster against the values, the place and the EPSG code that rasterio reads.
fn assert_same(raster: &Raster, found: &Value) {
    let name = file_name(found);
    assert!(are_same(raster.values(), &values(found)), "{name}");
    let transform: Vec<f64> =
        found["transform"].as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect();
    let (side, [west, south], [columns, rows]) = (raster.side(), raster.corner(), raster.extents());
    assert_eq!(json!([columns, rows]), found["extents"], "{name}");
    assert_eq!(transform, [side, 0.0, west, 0.0, -side, south + rows as f64 * side], "{name}");
    let epsg = raster.coordinate_system().and_then(|keys| keys.epsg());
    assert_eq!(json!(epsg), found["epsg"], "{name}");
}

#[test]
fn files_of_rasterio_are_read_and_ours_are_read_by_rasterio() {
    let folder = tempfile::tempdir().unwrap();
    let made = run("geotiff.py", [Path::new("make"), folder.path()]);
    assert_eq!(made.len(), 18);
    let mut written = Vec::new();
    for found in &made {
        let raster = Raster::read(&folder.path().join(file_name(found))).unwrap();
        assert_same(&raster, found);
        // The formula of the script, for the first cell of the last row of the file.
        let wanted = if found["type"].as_str().unwrap().starts_with("float") { 154.1 } else { 154.0 };
        let value = raster.value([0, 0]).unwrap();
        assert!((value - if found["type"] == "int8" { -102.0 } else { wanted }).abs() < 1e-5, "{value}");
        for samples in [SampleType::F32, SampleType::F64] {
            let path = folder.path().join(format!("{samples:?}_{}", file_name(found)));
            geotiff::write(&path, &raster, samples).unwrap();
            written.push((path, samples, found));
        }
    }
    let paths = written.iter().map(|(path, ..)| path.as_os_str());
    let read = run("geotiff.py", [Path::new("read").as_os_str()].into_iter().chain(paths));
    for ((path, samples, original), found) in written.iter().zip(&read) {
        let name = file_name(found);
        for key in ["crs", "epsg", "transform", "extents", "point"] {
            assert_eq!(found[key], original[key], "{key} of {name}");
        }
        let (kind, wanted) = match samples {
            SampleType::F32 => ("float32", values(original).iter().map(|v| f64::from(*v as f32)).collect()),
            SampleType::F64 => ("float64", values(original)),
        };
        assert_eq!(
            (found["type"].as_str(), found["nodata"].as_str(), &found["bands"]),
            (Some(kind), Some("nan"), &json!(1))
        );
        assert!(are_same(&values(found), &wanted), "{name}");
        assert_same(&Raster::read(path).unwrap(), found);
    }
}

#[test]
fn coordinate_systems_by_their_codes_are_those_of_rasterio() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("coded.tif");
    for (keys, wanted) in [(GeoKeys::projected(32633), 32633), (GeoKeys::geographic(4326), 4326)] {
        assert_eq!(keys.epsg(), Some(wanted));
        let raster = Raster::new([2, 2], 0.5, vec![1.0, 2.0, 3.0, 4.0]).unwrap().with_corner([15.0, 37.5]);
        let raster = raster.with_coordinate_system(Some(Arc::new(keys)));
        geotiff::write(&path, &raster, SampleType::F64).unwrap();
        let found = &run("geotiff.py", [Path::new("read"), &path])[0];
        assert_eq!(found["epsg"], json!(wanted));
        assert_same(&raster, found);
    }
}
