use super::*;
use proptest::prelude::*;
use std::fs;

const SPACE: Space =
    Space { origin: [-1.0, 0.0, 0.5], sides: [2.0, 3.5, 1e-7], periodic: [true, false, true] };

fn read_text(text: &str) -> Result<Vec<ReadFrame>, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.xyz");
    fs::write(&path, text).unwrap();
    read(&path).map_err(|error| {
        let message = error.to_string();
        message[message.find("a.xyz").unwrap()..].to_owned()
    })
}

#[test]
fn the_text_is_that_of_the_format() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.xyz");
    let columns = [
        Column::new("id", 1, Values::Whole(&[7, 4_000_000_000])),
        Column::new("velocity", 2, Values::F32(&[0.1, 1e-9, -0.0, 2.0])),
        Column::new("wet", 1, Values::Bool(&[true, false])),
        Column::new("phase", 1, Values::Text(&["Solid", "Liquid"])),
    ];
    write(&path, 0.25, Some(&SPACE), &[[0.5, 1.0, -2.0], [1e20, 0.1, 3.0]], &columns).unwrap();
    let lattice = r#"Lattice="2.0 0.0 0.0 0.0 3.5 0.0 0.0 0.0 1e-7" Origin="-1.0 0.0 0.5" pbc="T F T""#;
    let properties = "Properties=pos:R:3:id:I:1:velocity:R:2:wet:L:1:phase:S:1";
    let wanted = format!(
        "2\n{lattice} {properties} Time=0.25\n0.5 1.0 -2.0 7 0.1 1e-9 T Solid\n1e20 0.1 3.0 4000000000 -0.0 2.0 F Liquid\n"
    );
    assert_eq!(fs::read_to_string(&path).unwrap(), wanted);
    let frames = read(&path).unwrap();
    let [frame] = &frames[..] else { panic!("one frame") };
    assert_eq!((frame.time, frame.space), (Some(0.25), Some(SPACE)));
    let values: Vec<&ReadValues> = frame.columns.iter().map(|column| &column.values).collect();
    let velocity = vec![0.1, 1e-9, -0.0, 2.0];
    let phases = ["Solid", "Liquid"].map(str::to_owned).to_vec();
    let wanted = [
        &ReadValues::Whole(vec![7, 4_000_000_000]),
        &ReadValues::Real(velocity),
        &ReadValues::Bool(vec![true, false]),
        &ReadValues::Text(phases),
    ];
    assert_eq!(values, wanted);
}

#[test]
fn files_of_others_are_read() {
    // The columns of plain XYZ, several frames, other orders and quotes.
    let text = "1\n\nH 1 2 3\n2\nTime=1.5 note=\"a = b\" Properties=id:I:1:pos:R:3 Lattice='1 0 0 0 2 0 0 0 3' last\n\
                5 0 0 1\r\n 6\t0 0 2\n\n0\nProperties=pos:R:3\n";
    let frames = read_text(text).unwrap();
    assert_eq!(frames.len(), 3);
    assert_eq!(frames[0].positions, [[1.0, 2.0, 3.0]]);
    assert_eq!((frames[0].columns[0].name.as_str(), frames[0].space), ("species", None));
    assert_eq!(frames[1].positions, [[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]]);
    assert_eq!((frames[1].time, frames[1].space.unwrap().periodic), (Some(1.5), [true; 3]));
    assert_eq!(frames[1].columns[0].values, ReadValues::Whole(vec![5, 6]));
    assert!(frames[2].positions.is_empty());
}

#[test]
fn what_makes_no_sense_is_named_by_its_line() {
    let said = |text: &str| read_text(text).unwrap_err();
    assert_eq!(said("x\n"), "a.xyz:1: `x` is not a number of particles");
    assert_eq!(said("-1\n"), "a.xyz:1: `-1` is not a number of particles");
    assert_eq!(said("1\n"), "a.xyz:2: the file ends before its line of keys");
    assert_eq!(
        said("18446744073709551615\nProperties=pos:R:3\n1 2 3\n"),
        "a.xyz:4: the file ends after 1 of 18446744073709551615 particles"
    );
    assert_eq!(said("1\nProperties=pos:R:3\n1 2\n"), "a.xyz:3: the particle has too few values");
    assert_eq!(
        said("1\nProperties=pos:R:3\n1 2 3 4\n"),
        "a.xyz:3: `4` is more than the columns of a particle"
    );
    assert_eq!(said("1\nProperties=pos:R:3\n1 2 \u{1b}[31m\n"), "a.xyz:3: `\\u{1b}[31m` is not a number");
    assert_eq!(said("1\nProperties=id:I:1\n1\n"), "a.xyz:2: `id:I:1` has no column pos:R:3");
    assert_eq!(
        said("1\nProperties=pos:R:3:v:Q:1\n1\n"),
        "a.xyz:2: `Q` is no type of a column; there are R, I, L and S"
    );
    assert_eq!(
        said("1\nProperties=pos:R:3:v:R\n1\n"),
        "a.xyz:2: `pos:R:3:v:R` does not have a name, a type and a width for each column"
    );
    assert_eq!(
        said("1\nProperties=pos:R:3:v:R:999999999\n1\n"),
        "a.xyz:2: `999999999` is not the width of a column"
    );
    assert_eq!(said("1\nLattice=\"1 0\n1 2 3\n"), "a.xyz:2: the value of `Lattice` has no closing `\"`");
    assert_eq!(
        said("1\nLattice=\"1 1 0 0 1 0 0 0 1\"\n"),
        "a.xyz:2: `1 1 0 0 1 0 0 0 1` is not the lattice of a box along the axes"
    );
    assert_eq!(
        said("1\nLattice=\"1 0 0 0 1 0 0 0 1\" pbc=\"T F\"\n"),
        "a.xyz:2: `T F` does not have three axes"
    );
    assert_eq!(said("1\nTime=soon\n"), "a.xyz:2: `soon` is not a time");
}

#[test]
fn columns_that_do_not_fit_are_refused() {
    let path = Path::new("/nowhere/a.xyz");
    let said = |columns: &[Column<'_>]| write(path, 0.0, None, &[[0.0; 3]], columns).unwrap_err().to_string();
    let one = |name| Column::new(name, 1, Values::F64(&[1.0]));
    assert_eq!(
        said(&[one("a b")]),
        "cannot write /nowhere/a.xyz: the column name `a b` must be one word without `:`"
    );
    assert!(said(&[one("a:b")]).contains("`a:b` must be one word"));
    assert_eq!(said(&[one("v"), one("v")]), "cannot write /nowhere/a.xyz: two columns are named `v`");
    assert!(said(&[one("pos")]).contains("two columns are named `pos`"));
    assert!(
        said(&[Column::new("v", 2, Values::F64(&[1.0]))]).contains("`v` has 1 values for 1 particles of 2")
    );
    assert!(
        said(&[Column::new("v", 1, Values::Text(&["a b"]))]).contains("`a b` in column `v` must be one word")
    );
    assert_eq!(said(&[one("v")]), "cannot write /nowhere/a.xyz");
}

proptest! {
    #[test]
    fn every_number_comes_back_with_its_bits(
        positions in proptest::collection::vec(any::<[f64; 3]>(), 0..20),
        time in any::<f64>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.xyz");
        let numbers: Vec<f32> = positions.iter().map(|point| point[0] as f32).collect();
        let columns = [Column::new("v", 1, Values::F32(&numbers))];
        write(&path, time, None, &positions, &columns).unwrap();
        let frame = read(&path).unwrap().remove(0);
        let bits = |points: &[[f64; 3]]| points.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
        prop_assert_eq!(bits(&positions), bits(&frame.positions));
        prop_assert_eq!(frame.time.map(f64::to_bits), Some(time.to_bits()));
        let ReadValues::Real(back) = &frame.columns[0].values else { panic!("numbers") };
        let back: Vec<u32> = back.iter().map(|number| (*number as f32).to_bits()).collect();
        prop_assert_eq!(back, numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>());
    }
}
