//! ESRI ASCII grids and GeoTIFF in and out, and the landslide that runs over them.

use crate::running::{HEAT, LANDSLIDE, LIFE, Table, Workplace, report};
use std::fs;
use std::path::Path;
use std::sync::Arc;
use xca_run::io::geotiff::{self, GeoKeys, SampleType};
use xca_run::io::raster::Raster;

/// The header lines of a grid and its numbers, x fastest and from the south, as plainly as can be.
fn grid(path: &Path) -> (Vec<String>, Vec<f64>) {
    let text = fs::read_to_string(path).unwrap();
    let mut lines: Vec<&str> = text.lines().collect();
    let rows = lines.split_off(6);
    let numbers = |row: &&str| -> Vec<f64> { row.split(' ').map(|word| word.parse().unwrap()).collect() };
    (lines.into_iter().map(str::to_owned).collect(), rows.iter().rev().flat_map(numbers).collect())
}

#[test]
fn life_begins_from_a_grid_and_leaves_one() {
    let place = Workplace::new();
    // A glider in the south-west, moving to the south-west: after 4 steps it is one cell further each way.
    let cells = |glider: [[usize; 2]; 5]| {
        let mut cells = vec![0.0; 256 * 256];
        glider.into_iter().for_each(|[x, y]| cells[y * 256 + x] = 1.0);
        cells
    };
    let begin = cells([[10, 10], [11, 10], [12, 10], [10, 11], [11, 12]]);
    let rows =
        begin.chunks(256).rev().map(|row| row.iter().map(|cell| format!("{cell} ")).collect::<String>());
    let header = "NCOLS 256\nNROWS 256\nXLLCENTER 7.5\nYLLCENTER -2\nCELLSIZE 1\n";
    place.write("glider.asc", &format!("{header}{}\n", rows.collect::<Vec<_>>().join("\n")));
    place.succeed(LIFE, "--initial alive=glider.asc --formats +asc --steps 4");
    let (header, alive) = grid(&place.path("out/life/final_alive.asc"));
    assert_eq!(
        header,
        ["ncols 256", "nrows 256", "xllcorner 7", "yllcorner -2.5", "cellsize 1", "NODATA_value -9999"]
    );
    assert_eq!(alive, cells([[9, 9], [10, 9], [11, 9], [9, 10], [10, 11]]));
    let report = report(&place.path("out/life"));
    let files = report["files"].as_array().unwrap();
    assert!(files.iter().any(|file| file == "final_alive.asc"), "{files:?}");
    // The next run does not want them, and leaves none of an earlier one; and it cannot replace what it
    // begins from.
    fs::copy(place.path("out/life/final_alive.asc"), place.path("again.asc")).unwrap();
    place.succeed(LIFE, "--initial alive=again.asc --steps 1");
    assert!(!place.path("out/life/final_alive.asc").exists());
    place.succeed(LIFE, "--formats +asc --steps 1");
    let said = place.fail(2, LIFE, "--initial alive=out/life/final_alive.asc --steps 1");
    assert!(
        said.contains("the run starts from out/life/final_alive.asc, which it would overwrite"),
        "{said}"
    );
}

/// In either precision the grids hold every bit: a run that begins from them goes on as if there had been no
/// break.
#[test]
fn a_landslide_goes_on_from_its_grids() {
    for precision in ["f32", "f64"] {
        let place = Workplace::new();
        let options = format!("--precision {precision} --engine reference");
        place.succeed(LANDSLIDE, &format!("{options} --steps 70 --out whole"));
        place.succeed(LANDSLIDE, &format!("{options} --steps 40 --out part"));
        let map = "--dem part/final_altitude.asc --debris part/final_thickness.asc";
        place.succeed(LANDSLIDE, &format!("{options} --steps 30 {map} --out rest"));
        for file in ["final_altitude.asc", "final_thickness.asc", "final_outflow_0.asc"] {
            let [whole, rest] = ["whole", "rest"].map(|run| fs::read(place.path(run).join(file)).unwrap());
            assert!(whole == rest, "{file} in {precision}");
        }
    }
}

/// Place, holes and coordinate system go through a run, and the numbers are those of the run over the same
/// text grids.
#[test]
fn a_landslide_runs_from_geotiff_to_geotiff() {
    let place = Workplace::new();
    let system = Arc::new(GeoKeys::projected(32633));
    let ground = |x: usize, y: usize| if (x, y) == (2, 3) { f64::NAN } else { (7 * y + (x * x) % 5) as f64 };
    let debris = |x: usize, y: usize| if (2..5).contains(&x) && y == 6 { 4.5 } else { 0.0 };
    for (name, height) in [("ground", &ground as &dyn Fn(usize, usize) -> f64), ("debris", &debris)] {
        let values = (0..8).flat_map(|y| (0..6).map(move |x| height(x, y))).collect();
        let raster = Raster::new([6, 8], 10.0, values).unwrap().with_corner([499_000.0, 4_177_000.0]);
        xca_run::io::ascii_grid::write(&place.path(&format!("{name}.asc")), &raster).unwrap();
        let raster = raster.with_coordinate_system(Some(system.clone()));
        geotiff::write(&place.path(&format!("{name}.tif")), &raster, SampleType::F32).unwrap();
    }
    for (precision, bits) in [("f32", 32), ("f64", 64)] {
        for kind in ["asc", "tif"] {
            let files = format!("--dem ground.{kind} --debris debris.{kind} --out {kind}");
            place.succeed(LANDSLIDE, &format!("--precision {precision} {files} --formats asc,tif --steps 5"));
        }
        for name in ["final_thickness", "final_altitude", "final_outflow_1"] {
            let read = |folder: &str, kind: &str| {
                Raster::read(&place.path(folder).join(format!("{name}.{kind}"))).unwrap()
            };
            let (text, image) = (read("asc", "asc"), read("tif", "tif"));
            assert_eq!(image.placement(), text.placement(), "{name}");
            assert_eq!(image.coordinate_system(), Some(&system), "{name}");
            assert_eq!(read("asc", "tif").coordinate_system(), None);
            for (cell, (text, image)) in text.values().iter().zip(image.values()).enumerate() {
                let same = if bits == 32 { *text as f32 == *image as f32 } else { text == image };
                assert!(same || text.is_nan() && image.is_nan(), "{name} in cell {cell}: {text} {image}");
            }
            assert!(image.values()[3 * 6 + 2].is_nan(), "{name}");
        }
        assert!(place.path("tif/final_thickness.tif").metadata().unwrap().len() < 2000);
    }
    let report = report(&place.path("tif"));
    assert_eq!((&report["map"]["epsg"], &report["map"]["cells_without_ground"]), (&32633.into(), &1.into()));
    let said = place.fail(2, LIFE, "--initial alive=ground.tif");
    assert!(
        said.contains("ground.tif does not lie on the model: it has 6 x 8 cells, not 256 x 256"),
        "{said}"
    );
}

#[test]
fn grids_that_do_not_fit_are_refused() {
    let place = Workplace::new();
    let header = "xllcorner 0\nyllcorner 0\n";
    place.write("small.asc", &format!("ncols 2\nnrows 2\n{header}cellsize 1\n0 1\n1 0\n"));
    let rows = |cell: &str| format!("{cell} ").repeat(256 * 256 - 1);
    let whole = format!("ncols 256\nnrows 256\n{header}");
    place.write("wide.asc", &format!("{whole}cellsize 2\n{} 0\n", rows("0")));
    place.write("half.asc", &format!("{whole}cellsize 1\n{} 0.5\n", rows("0")));
    let hole = rows("0").replacen("0 0", "0 -1", 1);
    place.write("empty.asc", &format!("{whole}cellsize 1\nNODATA_value -1\n{hole} 0\n"));
    place.write("short.asc", &format!("{whole}cellsize 1\n{}\n", rows("0")));
    place.write("slope.asc", &format!("ncols 2\nnrows 3\n{header}cellsize 1\n1 2 3 4 5 6\n"));
    place.write("hole.asc", &format!("ncols 2\nnrows 2\n{header}cellsize 1\n1 2 -3 4\n"));
    for (program, options, wanted) in [
        (
            LIFE,
            "--initial alive=small.asc",
            "small.asc does not lie on the model: it has 2 x 2 cells, not 256 x 256",
        ),
        (
            LIFE,
            "--initial alive=wide.asc",
            "wide.asc does not lie on the model: its cells have a side of 2, not 1",
        ),
        (LIFE, "--initial alive=half.asc", "0.5 in cell [255, 0, 0] is no value for `alive`, which is a u8"),
        (
            LIFE,
            "--initial alive=short.asc",
            "short.asc: 65535 values, but 256 columns and 256 rows have 65536 cells",
        ),
        (LIFE, "--initial heat=half.asc", "unknown substate of cells `heat`; there are Life.alive"),
        (LIFE, "--initial alive=nowhere.asc", "cannot open the grid nowhere.asc"),
        (LIFE, "--initial alive", "write NAME=FILE, such as altitude=ground.asc"),
        (HEAT, "--initial temperature=small.asc", "--initial is for models of one layer, and `heat` has 64"),
        (HEAT, "--formats +asc", "the format asc is for models of one layer, and `heat` has 64"),
        (LANDSLIDE, "--dem small.asc", "add --debris FILE"),
        (
            LANDSLIDE,
            "--dem small.asc --debris slope.asc",
            "slope.asc does not lie on small.asc: it has 2 x 3 cells, not 2 x 2",
        ),
        (
            LANDSLIDE,
            "--dem small.asc --debris hole.asc",
            "hole.asc: a thickness of -3 m in column 1, row 2 from the north",
        ),
        (LANDSLIDE, "--debris hole.asc", "--dem"),
    ] {
        let said = place.fail(2, program, options);
        assert!(said.contains(wanted), "{options}: {said}");
    }
    let said = place.fail(2, LIFE, "--initial alive=empty.asc");
    assert!(said.contains("empty.asc has NODATA in column 2, row 1 from the north"), "{said}");
}

/// The common height to which `mobile` levels out over cells of these heights, found by filling up from the
/// lowest.
fn common_level(mut heights: Vec<f64>, mobile: f64) -> f64 {
    heights.sort_by(f64::total_cmp);
    for full in 1..heights.len() {
        let needed: f64 = heights[..full].iter().map(|height| heights[full] - height).sum();
        if needed >= mobile {
            return (mobile + heights[..full].iter().sum::<f64>()) / full as f64;
        }
    }
    (mobile + heights.iter().sum::<f64>()) / heights.len() as f64
}

/// One step of the landslide as its description says it, from cell to cell rather than from flow to flow.
fn oracle(altitude: &[f64], thickness: &[f64], columns: usize, [adherence, rate]: [f64; 2]) -> Vec<f64> {
    let mut next = thickness.to_vec();
    for cell in 0..thickness.len() {
        let mobile = thickness[cell] - adherence;
        if mobile <= 0.0 {
            continue;
        }
        let (x, rows) = (cell % columns, thickness.len() / columns);
        let inside = [x > 0, x + 1 < columns, cell >= columns, cell / columns + 1 < rows];
        let steps = [cell.wrapping_sub(1), cell + 1, cell.wrapping_sub(columns), cell + columns];
        let others: Vec<usize> =
            steps.into_iter().zip(inside).filter_map(|(other, inside)| inside.then_some(other)).collect();
        let own = [altitude[cell] + adherence];
        let heights = own.into_iter().chain(others.iter().map(|&other| altitude[other] + thickness[other]));
        let level = common_level(heights.collect(), mobile);
        for other in others {
            let moved = rate * (level - altitude[other] - thickness[other]).max(0.0);
            next[other] += moved;
            next[cell] -= moved;
        }
    }
    next
}

#[test]
fn a_landslide_levels_out_as_its_description_says() {
    let place = Workplace::new();
    let parameters = "--set adherence=0.4 --set rate=0.6";
    place.succeed(LANDSLIDE, &format!("{parameters} --steps 0 --out begin"));
    let (_, altitude) = grid(&place.path("begin/final_altitude.asc"));
    let (_, mut thickness) = grid(&place.path("begin/final_thickness.asc"));
    for _ in 0..60 {
        thickness = oracle(&altitude, &thickness, 160, [0.4, 0.6]);
    }
    place.succeed(LANDSLIDE, &format!("{parameters} --steps 60 --out end"));
    let (_, ended) = grid(&place.path("end/final_thickness.asc"));
    let apart = ended.iter().zip(&thickness).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-9, "{apart}");
    let moved = thickness.iter().filter(|thickness| **thickness > 0.4).count();
    assert!(moved > 700, "{moved}");
}

/// Debris is neither lost nor made, runs downhill, and comes to rest.
#[test]
fn a_landslide_keeps_its_volume_and_comes_to_rest() {
    let place = Workplace::new();
    let said = place.succeed(LANDSLIDE, "--until 0.02 --steps 9000 --every 20");
    assert!(said.contains("no cell sends more than 0.02 m"), "{said}");
    let series = Table::read(&place.path("out/landslide/observables.csv"));
    let volumes = series.column("volume");
    assert!(volumes.iter().all(|volume| (volume / volumes[0] - 1.0).abs() < 1e-12));
    let front = series.column("front_from_south");
    assert!(front[0] > 2000.0 && *front.last().unwrap() < 1000.0);
    assert!(front.is_sorted_by(|before, after| before >= after), "{front:?}");
    let (_, thickness) = grid(&place.path("out/landslide/final_thickness.asc"));
    assert!(thickness.iter().all(|thickness| *thickness >= 0.0));
}
