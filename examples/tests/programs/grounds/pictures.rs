//! Pictures of a map: its coordinates, and the background where there is no ground.

use super::island::{is_land, island};
use crate::running::{LANDSLIDE, Workplace};
use std::fs;
use std::path::Path;
use std::sync::Arc;
use xca_run::io::geotiff::{self, GeoKeys, SampleType};
use xca_run::io::raster::Raster;

/// Width and pixels of a picture.
fn pixels(path: &Path) -> (usize, Vec<[u8; 3]>) {
    let mut reader =
        png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.width as usize, pixels.as_chunks::<3>().0.to_vec())
}

/// The colours of the pixel in the middle of each cell of a slice of a map.
fn colours(path: &Path, [columns, rows]: [usize; 2]) -> Vec<[u8; 3]> {
    let (width, pixels) = pixels(path);
    // The drawing begins 96 pixels from the left and 120 from the top; a cell has the same whole number of
    // pixels each way.
    let side = 768 / columns.max(rows);
    let colour = |cell: usize| {
        let (x, y) =
            (96 + (cell % columns) * side + side / 2, 120 + (rows - 1 - cell / columns) * side + side / 2);
        pixels[y * width + x]
    };
    (0..columns * rows).map(colour).collect()
}

/// The ticks are at the pixels of eastings and northings: 153 pixels are 10 m.
#[test]
fn pictures_on_a_map_have_its_coordinates() {
    let place = Workplace::new();
    island(&place);
    for file in ["g.asc", "d.asc"] {
        let text = place.read(file).replace("xllcorner 2600", "xllcorner 2602");
        place.write(file, &text.replace("yllcorner 5100", "yllcorner 5101"));
    }
    place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --steps 0");
    let (width, pixels) = pixels(&place.path("out/landslide/final.png"));
    let is_dark = |x: usize, y: usize| pixels[y * width + x][0] < 100;
    let below: Vec<usize> = (0..96 + 765).filter(|x| is_dark(*x, 120 + 765 + 4)).collect();
    let beside: Vec<usize> = (120..120 + 765).filter(|y| is_dark(96 - 5, *y)).collect();
    // Every 5 m: the first ticks are 2605 and 5105, 3 and 4 m from the corner.
    let wanted = |first: usize| (0..10).map(move |i| 153 * (first + 5 * i) / 10);
    assert_eq!(below, wanted(3).map(|at| 96 + at).collect::<Vec<_>>());
    assert_eq!(beside, wanted(4).rev().map(|at| 120 + 764 - at).collect::<Vec<_>>());
}

#[test]
fn pictures_show_the_background_where_there_is_no_ground() {
    let place = Workplace::new();
    island(&place);
    place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --steps 10");
    let seen = colours(&place.path("out/landslide/final.png"), [5, 5]);
    for (cell, colour) in seen.iter().enumerate() {
        assert_eq!(*colour == [255; 3], !is_land(cell), "{cell}: {colour:?}");
    }
    // A slope of 1 in 10 is seen as one: the wall around it is not in the relief.
    let beside = colours(&place.path("out/landslide/initial.png"), [5, 5]);
    assert!(beside[6] != [255; 3] && beside[11].iter().all(|lane| *lane > 100), "{beside:?}");
    // The same from what the run has saved, and of another substate, on the scale of the ground.
    let drawn =
        place.invocation(LANDSLIDE, "render out/landslide --substate altitude --out drawn").output().unwrap();
    assert!(drawn.status.success(), "{}", String::from_utf8_lossy(&drawn.stderr));
    let seen = colours(&place.path("drawn/frames/frame_00000010.png"), [5, 5]);
    assert_eq!([seen[0], seen[4], seen[24]], [[255; 3]; 3]);
    // 500 and 502 are the ends of the scale.
    let brightness = |colour: [u8; 3]| colour.iter().map(|lane| u32::from(*lane)).sum::<u32>();
    assert!(brightness(seen[8]) > brightness(seen[6]) + 100, "{seen:?}");
}

/// The same ground in metres and in degrees: only the names of the axes and their unit differ.
#[test]
fn axes_of_a_map_in_degrees_say_so() {
    let picture = |keys: GeoKeys| {
        let place = Workplace::new();
        let raster = |values: Vec<f64>| {
            let raster = Raster::new([5, 5], 10.0, values).unwrap().with_corner([10.0, 40.0]);
            raster.with_coordinate_system(Some(Arc::new(keys.clone())))
        };
        geotiff::write(&place.path("g.tif"), &raster(vec![500.0; 25]), SampleType::F64).unwrap();
        let debris = (0..25).map(|cell| if cell == 12 { 5.0 } else { 0.0 }).collect();
        geotiff::write(&place.path("d.tif"), &raster(debris), SampleType::F64).unwrap();
        place.succeed(LANDSLIDE, "--dem g.tif --debris d.tif --steps 0");
        let report = fs::read_to_string(place.path("out/landslide/run.json")).unwrap();
        let warning =
            "the map is in degrees, but the model counts in metres and takes its cells as 10 m wide";
        assert_eq!(report.contains(warning), keys == GeoKeys::geographic(4326));
        pixels(&place.path("out/landslide/final.png"))
    };
    let [(width, metres), (_, degrees)] =
        [GeoKeys::projected(32_633), GeoKeys::geographic(4326)].map(picture);
    let places = (0..metres.len()).filter(|place| metres[*place] != degrees[*place]);
    let places: Vec<[usize; 2]> = places.map(|place| [place % width, place / width]).collect();
    // The name of the vertical axis is above the drawing, that of the horizontal one below.
    let is_above = |place: &[usize; 2]| place[1] < 120;
    let is_below = |place: &[usize; 2]| place[1] > 120 + 765;
    assert!(places.iter().any(is_above) && places.iter().any(is_below), "{}", places.len());
    assert!(places.iter().all(|place| is_above(place) || is_below(place)));
}
