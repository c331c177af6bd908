use super::super::{DataArray, Values, ghost_types, write_dense, write_hexagons, write_particles};
use super::*;
use crate::lattice::Lattice;
use std::fs;
use tempfile::TempDir;

fn bytes<T, const N: usize>(numbers: &[T], of: impl Fn(&T) -> [u8; N]) -> Vec<u8> {
    numbers.iter().flat_map(of).collect()
}

const GRID: Grid = Grid { cells: [3, 1, 2], origin: [0.0, -0.5, 1e300], spacing: [0.1, 0.25, 1e-7] };

fn dense() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("d.vti");
    let arrays = [
        DataArray::new("alive", &[1_u8, 0, 1, 1, 0, 9][..]),
        DataArray::new("a < \"b\" & >", &[[1.5_f32, f32::NAN]; 6][..]),
        DataArray::new("depth", &[-1_i32, 2, i32::MIN, 4, 5, i32::MAX][..]),
    ];
    write_dense(&path, -1.25e-3, &GRID, &arrays).unwrap();
    (folder, path)
}

fn particles(count: usize) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.vtp");
    let positions: Vec<[f64; 3]> = (0..count).map(|i| [i as f64, 0.1, f64::NEG_INFINITY]).collect();
    let labels: Vec<u32> = (0..count).map(|i| u32::MAX - i as u32).collect();
    // Bytes that look like the end of the file and the beginning of its data.
    let labelled = DataArray::new("label", &labels[..]);
    // Bytes that look like the end of the file and the beginning of its data.
    let text = b"\n</AppendedData>\n<AppendedData encoding=\"raw\">\n_";
    let components = text.len() / count.max(1);
    let text = Values::interleaved(components, &text[..count * components]);
    let arrays = [labelled, DataArray::new("text", text)];
    write_particles(&path, 0.5, positions[..].into(), &arrays).unwrap();
    (folder, path)
}

#[test]
fn what_is_written_of_cells_is_read_back_to_the_last_bit() {
    let (_folder, path) = dense();
    let file = read_dense(&path, u64::MAX).unwrap();
    assert_eq!((file.time, file.grid), (-1.25e-3, GRID));
    let found: Vec<(&str, NumberType, usize)> =
        file.arrays.iter().map(|array| (array.name.as_str(), array.numbers, array.components)).collect();
    let wanted =
        [("alive", NumberType::U8, 1), ("a < \"b\" & >", NumberType::F32, 2), ("depth", NumberType::I32, 1)];
    assert_eq!(found, wanted);
    assert_eq!(file.arrays[0].bytes, [1, 0, 1, 1, 0, 9]);
    assert_eq!(file.arrays[1].bytes, bytes(&[[1.5_f32, f32::NAN]; 6].concat(), |x| x.to_ne_bytes()));
    assert_eq!(file.arrays[2].bytes, bytes(&[-1_i32, 2, i32::MIN, 4, 5, i32::MAX], |x| x.to_ne_bytes()));
}

#[test]
fn names_of_components_and_states_are_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("d.vti");
    let names = |names: &[&str]| -> Vec<String> { names.iter().map(|name| (*name).to_owned()).collect() };
    let (elements, ground) =
        (names(&["[0].x", "[0].y", "[1].x", "[1].y"]), names(&["Rock", "Öl & <Wasser>"]));
    let arrays = [
        DataArray::new("paths", &[[1_i32, 2, 3, 4]; 6][..]).with_components(&elements),
        DataArray::new("a \"b\"", &[1_u8, 0, 1, 1, 0, 0][..]).with_states(&ground),
        DataArray::new("flow", &[[0.5_f64; 3]; 6][..]),
        DataArray::new("many", &[[0_u8; 5]; 6][..]),
    ];
    write_dense(&path, 0.0, &GRID, &arrays).unwrap();
    let file = read_dense(&path, u64::MAX).unwrap();
    let found = |number: usize| &file.arrays[number];
    assert_eq!((&found(0).component_names, found(0).states.len()), (&elements, 0));
    assert_eq!((&found(1).component_names, &found(1).states), (&names(&[]), &ground));
    assert_eq!(found(0).component_name(3), "[1].y");
    assert_eq!((found(1).component_name(0).as_str(), found(2).component_name(2).as_str()), ("", ".z"));
    assert_eq!(found(3).component_name(4), "[4]");
    // Names that are not valid text.
    let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
    assert!(text.contains(">82 111 99 107 0 195 150 108 "), "{text}");
    let mut bytes = fs::read(&path).unwrap();
    let place = bytes.windows(4).position(|window| window == b"195 ").unwrap();
    bytes[place..place + 3].copy_from_slice(b"300");
    fs::write(&path, bytes).unwrap();
    let error = read_dense(&path, u64::MAX).unwrap_err().to_string();
    assert!(error.contains("one of its arrays is invalid"), "{error}");
}

#[test]
fn what_is_written_of_particles_is_read_back_to_the_last_bit() {
    for count in [0, 1, 4] {
        let (_folder, path) = particles(count);
        let file = read_particles(&path, u64::MAX).unwrap();
        assert_eq!(file.time, 0.5);
        assert_eq!((file.positions.numbers, file.positions.components), (NumberType::F64, 3));
        let points: Vec<f64> = (0..count).flat_map(|i| [i as f64, 0.1, f64::NEG_INFINITY]).collect();
        assert_eq!(file.positions.bytes, bytes(&points, |x| x.to_ne_bytes()));
        assert_eq!((file.arrays[0].name.as_str(), file.arrays[0].numbers), ("label", NumberType::U32));
        let labels: Vec<u32> = (0..count).map(|i| u32::MAX - i as u32).collect();
        assert_eq!(file.arrays[0].bytes, bytes(&labels, |x| x.to_ne_bytes()));
        assert_eq!(file.arrays.len(), 2);
    }
}

#[test]
fn a_truncated_file_is_refused_wherever_it_ends() {
    for (path, read) in [
        (dense(), (|path| read_dense(path, u64::MAX).map(drop)) as fn(&Path) -> Result<(), ReadVtkError>),
        (particles(4), |path| read_particles(path, u64::MAX).map(drop)),
    ] {
        let ((_folder, path), whole) = (&path, fs::read(&path.1).unwrap());
        // Every length near the end, and some before it.
        let near_end = |length: &usize| length.is_multiple_of(7) || length + 60 > whole.len();
        for length in (0..whole.len()).filter(near_end) {
            fs::write(path, &whole[..length]).unwrap();
            let error = read(path).unwrap_err();
            let ReadVtkError::Truncated { found, .. } = &error else { panic!("{length}: {error}") };
            assert_eq!(*found, length, "{error}");
        }
        fs::write(path, &whole).unwrap();
        read(path).unwrap();
        fs::write(path, [&whole[..], b"x"].concat()).unwrap();
        assert!(read(path).unwrap_err().to_string().contains("it continues where it should end"));
    }
}

#[test]
fn a_file_of_something_else_is_refused() {
    let (_folder, path) = dense();
    let whole = fs::read(&path).unwrap();
    let error = read_particles(&path, u64::MAX).unwrap_err().to_string();
    assert!(error.contains("d.vti is not a VTK file as this program writes them"), "{error}");
    let text = String::from_utf8_lossy(&whole).into_owned();
    // Only the XML lines are text, and only they are to be changed.
    let changed = |from: &str, to: &str| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        let at = text.find(from).unwrap();
        let bytes = [&whole[..at], to.as_bytes(), &whole[at + from.len()..]].concat();
        fs::write(&path, bytes).unwrap();
        read_dense(&path, u64::MAX).unwrap_err().to_string()
    };
    for (from, to, wanted) in [
        ("type=\"UInt8\"", "type=\"UInt9\"", "one of its arrays"),
        (
            "Name=\"alive\" NumberOfComponents=\"1\" format=\"appended\" offset=\"",
            "Name=\"alive\" NumberOfComponents=\"1\" format=\"appended\" offset=\"1",
            "one of its arrays",
        ),
        ("NumberOfComponents=\"2\"", "NumberOfComponents=\"0\"", "one of its arrays"),
        ("Name=\"TimeValue\"", "Name=\"Time\"", "one of its arrays"),
        (
            "Name=\"depth\" NumberOfComponents=\"1\"",
            "Name=\"depth\" NumberOfComponents=\"1\" NumberOfTuples=\"1\"",
            "one of its arrays",
        ),
        (
            "Name=\"depth\" NumberOfComponents=\"1\"",
            "Name=\"depth\" NumberOfComponents=\"9000000000000000\"",
            "one of its arrays",
        ),
        ("Origin=\"0.0 ", "Origin=\"", "its grid"),
        ("<Piece Extent=\"0 3 0 1 0 2\"", "<Piece Extent=\"0 3 0 1 1 2\"", "its grid"),
        (
            "<Piece Extent=\"0 3 0 1 0 2\"",
            "<Piece Extent=\"0 4294967295 0 4294967295 0 4294967295\"",
            "its grid",
        ),
        ("vtkZLibDataCompressor", "vtkLZ4DataCompressor", "its first lines"),
        ("Name=\"depth\" NumberOfComponents=\"1\"", "Name=\"depth\" NumberOfComponents=\"9\"", "its data"),
    ] {
        let error = changed(from, to);
        assert!(error.contains(wanted), "{to}: {error}");
    }
    // The length before the values of the first array.
    let data = whole.windows(DATA.len()).position(|window| window == DATA.as_bytes()).unwrap() + DATA.len();
    let mut bytes = whole.clone();
    bytes[data + 16] ^= 1;
    fs::write(&path, bytes).unwrap();
    assert!(
        read_dense(&path, u64::MAX).unwrap_err().to_string().contains("its data do not match its arrays")
    );
    assert!(
        read_dense(Path::new("/nowhere/d.vti"), u64::MAX)
            .unwrap_err()
            .to_string()
            .contains("cannot read /nowhere")
    );
}

#[test]
fn hidden_cells_come_back_apart_from_the_substates() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("d.vti");
    let hidden = [true, false, false, true, false, false];
    let ghosts = ghost_types(&hidden);
    assert_eq!(ghosts[..2], [32, 0]);
    let values = [1.0; 6];
    let arrays = [DataArray::new("t", &values[..]), DataArray::new(GHOST_TYPE, &ghosts[..])];
    write_dense(&path, 0.0, &GRID, &arrays).unwrap();
    let file = read_dense(&path, u64::MAX).unwrap();
    assert_eq!((file.hidden.as_deref(), file.arrays.len()), (Some(&hidden[..]), 1));
    write_dense(&path, 0.0, &GRID, &arrays[..1]).unwrap();
    assert_eq!(read_dense(&path, u64::MAX).unwrap().hidden, None);
    let wide = [[0_u8; 2]; 6];
    write_dense(&path, 0.0, &GRID, &[DataArray::new(GHOST_TYPE, &wide[..])]).unwrap();
    assert!(read_dense(&path, u64::MAX).unwrap_err().to_string().contains("its ghost types are invalid"));
}

#[test]
fn values_that_do_not_fit_are_refused_before_they_are_expanded() {
    let (_folder, path) = dense();
    // The time, and 6 cells with 1, 8 and 4 bytes.
    let needed = 8 + 6 * 13;
    read_dense(&path, needed).unwrap();
    let error = read_dense(&path, needed - 1).unwrap_err().to_string();
    assert!(error.contains("d.vti take 86 bytes of memory, and 85 are free"), "{error}");
    // A short file cannot hold what its head promises.
    let text = fs::read(&path).unwrap();
    let more = b"Extent=\"0 30000 0 30000 0 10000\"";
    let place = text.windows(20).rposition(|window| window == b"Extent=\"0 3 0 1 0 2\"").unwrap();
    fs::write(&path, [&text[..place], more, &text[place + 20..]].concat()).unwrap();
    let error = read_dense(&path, u64::MAX).unwrap_err();
    assert!(matches!(error, ReadVtkError::Truncated { .. }), "{error}");
}

#[test]
fn names_of_components_take_no_more_than_the_file_has() {
    let (_folder, path) = particles(0);
    let text = fs::read(&path).unwrap();
    let from = &b"Name=\"label\" NumberOfComponents=\"1\""[..];
    let place = text.windows(from.len()).position(|window| window == from).unwrap();
    let to = b"Name=\"label\" NumberOfComponents=\"1048576\"";
    fs::write(&path, [&text[..place], to, &text[place + from.len()..]].concat()).unwrap();
    let file = read_particles(&path, u64::MAX).unwrap();
    assert_eq!((file.arrays[0].components, file.arrays[0].component_names.len()), (1 << 20, 0));
    assert_eq!(file.arrays[0].component_name(1_000_000), "[1000000]");
    // The name of an array may look like that of a component.
    let arrays = [DataArray::new("a ComponentName0=", &[[1_u8, 2]; 6][..])];
    write_dense(&path, 0.0, &GRID, &arrays).unwrap();
    let array = read_dense(&path, u64::MAX).unwrap().arrays.remove(0);
    assert_eq!((array.name.as_str(), array.component_name(0).as_str()), ("a ComponentName0=", ".x"));
}

fn hexagons(lattice: Lattice) -> (TempDir, PathBuf, HexagonGrid) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.vtp");
    let grid = HexagonGrid { cells: [3, 1, 2], lattice, corner: [-0.1, 1e300], side: 1e-7 };
    let ghosts = ghost_types(&[false, true, false, false, false, false]);
    // A substate may have the name of the array that groups points.
    let arrays = [
        DataArray::new("Points", &[[1_i32, -2]; 6][..]),
        DataArray::new("connectivity", &[0.5_f32, 1.0, 2.0, 3.0, 4.0, f32::NAN][..]),
        DataArray::new("extents", &[7_u8; 6][..]),
        DataArray::new(GHOST_TYPE, &ghosts[..]),
    ];
    write_hexagons(&path, 0.25, &grid, &arrays).unwrap();
    (folder, path, grid)
}

#[test]
fn what_is_written_of_hexagons_is_read_back_to_the_last_bit() {
    for lattice in [Lattice::HexagonRows, Lattice::HexagonColumns] {
        let (_folder, path, grid) = hexagons(lattice);
        let file = read_hexagons(&path, u64::MAX).unwrap();
        assert_eq!((file.time, file.grid), (0.25, grid));
        assert_eq!(file.hidden.as_deref(), Some(&[false, true, false, false, false, false][..]));
        let names: Vec<&str> = file.arrays.iter().map(|array| array.name.as_str()).collect();
        assert_eq!(names, ["Points", "connectivity", "extents"]);
        assert_eq!(file.arrays[0].bytes, bytes(&[[1_i32, -2]; 6].concat(), |x| x.to_ne_bytes()));
        let numbers = [0.5_f32, 1.0, 2.0, 3.0, 4.0, f32::NAN];
        assert_eq!(file.arrays[1].bytes, bytes(&numbers, |x| x.to_ne_bytes()));
        let either = read_poly_data(&path, u64::MAX).unwrap();
        assert!(matches!(either, PolyDataFile::Hexagons(HexagonFile { grid: found, .. }) if found == grid));
    }
    let (_folder, path) = particles(3);
    assert!(matches!(read_poly_data(&path, u64::MAX).unwrap(), PolyDataFile::Particles(_)));
    assert!(read_hexagons(&path, u64::MAX).is_err());
}

#[test]
fn hexagons_that_make_no_sense_are_refused() {
    let (_folder, path, grid) = hexagons(Lattice::HexagonRows);
    let whole = fs::read(&path).unwrap();
    let text = String::from_utf8_lossy(&whole).into_owned();
    for (from, to, wanted) in [
        (">3.0 1.0 2.0<", ">3.0 1.0 2.5<", "its grid"),
        (">3.0 1.0 2.0<", ">3.0 1.0 -2.0<", "its grid"),
        (">3.0 1.0 2.0<", ">2e9 2e9 2e9<", "its grid"),
        (">3.0 1.0 2.0<", ">3.0 1.0 3.0<", "its cells"),
        ("Name=\"side\"", "Name=\"edge\"", "its grid"),
        (">1.0<", ">2.0<", "its grid"),
        ("NumberOfPoints=\"36\"", "NumberOfPoints=\"35\"", "its cells"),
        ("NumberOfPolys=\"6\"", "NumberOfPolys=\"7\"", "its cells"),
        ("Name=\"offsets\"", "Name=\"offset\"", "it has no points"),
    ] {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        let at = text.find(from).unwrap();
        fs::write(&path, [&whole[..at], to.as_bytes(), &whole[at + from.len()..]].concat()).unwrap();
        let error = read_poly_data(&path, u64::MAX).unwrap_err().to_string();
        assert!(error.contains(wanted), "{to}: {error}");
    }
    for length in 0..whole.len() {
        fs::write(&path, &whole[..length]).unwrap();
        let error = read_poly_data(&path, u64::MAX).unwrap_err();
        assert!(matches!(error, ReadVtkError::Truncated { .. }), "{length}: {error}");
    }
    // Values that cannot be written.
    let values = [0.0; 6];
    let arrays = [DataArray::new("t", &values[..])];
    let error = |grid: HexagonGrid| write_hexagons(&path, 0.0, &grid, &arrays).unwrap_err().to_string();
    assert!(error(HexagonGrid { side: 0.0, ..grid }).contains("a side of the cells is 0"));
    assert!(error(HexagonGrid { corner: [f64::NAN, 0.0], ..grid }).contains("a coordinate of the corner"));
    assert!(error(HexagonGrid { cells: [3, 3, 1], ..grid }).contains("has 6 entries, not 9"));
    assert!(
        error(HexagonGrid { lattice: Lattice::Squares, ..grid })
            .contains("the number of corners of a cell is 4")
    );
}
