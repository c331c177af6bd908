//! Extended XYZ read and written by ASE.

use super::{number, run};
use serde_json::json;
use std::path::Path;
use xca_io::extended_xyz::{self, Column, ReadValues, Space, Values};

#[test]
fn our_frames_are_read_by_ase() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("spheres.xyz");
    let space = Space { origin: [-1.0, 0.25, 0.0], sides: [2.0, 3.0, 0.1], periodic: [true, false, true] };
    let positions = [[0.1 + 0.2, 5e-324, -0.0], [1e300, 2.0, 1.0 / 3.0], [1.0, 2.0, 3.0]];
    let vectors = [0.1_f32, 1e-30, -2.0, 3.0, f32::MAX, 0.0, 1.0, 2.0, 3.0];
    let columns = [
        Column::new("id", 1, Values::Whole(&[1, 7, 2_000_000_000])),
        Column::new("radius", 1, Values::F64(&[0.5; 3])),
        Column::new("velocity", 3, Values::F32(&vectors)),
        Column::new("wet", 1, Values::Bool(&[true, false, false])),
        Column::new("phase", 1, Values::Text(&["Solid", "Liquid", "Solid"])),
    ];
    extended_xyz::write(&path, 1.0 / 3.0, Some(&space), &positions, &columns).unwrap();
    let found = &run("extended_xyz.py", [Path::new("read"), &path])[0];
    let numbers =
        |value: &serde_json::Value| value.as_array().unwrap().iter().map(number).collect::<Vec<f64>>();
    assert_eq!(numbers(&found["cell"]), [2.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.1]);
    assert_eq!(found["pbc"], json!([true, false, true]));
    assert_eq!(
        (numbers(&found["time"]), numbers(&found["origin"])),
        (vec![1.0 / 3.0], vec![-1.0, 0.25, 0.0])
    );
    let column = |name: &str| &found["columns"][name];
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&numbers(&column("positions")["values"])), bits(positions.as_flattened()));
    assert_eq!((&column("id")["kind"], numbers(&column("id")["values"])), (&json!("i"), vec![1.0, 7.0, 2e9]));
    assert_eq!(numbers(&column("radius")["values"]), [0.5; 3]);
    assert_eq!(column("velocity")["shape"], json!([3, 3]));
    let velocities = numbers(&column("velocity")["values"]);
    assert!(velocities.iter().zip(vectors).all(|(found, wanted)| *found as f32 == wanted), "{velocities:?}");
    assert_eq!(
        (&column("wet")["kind"], numbers(&column("wet")["values"])),
        (&json!("b"), vec![1.0, 0.0, 0.0])
    );
    assert_eq!(column("phase")["values"], json!(["Solid", "Liquid", "Solid"]));
}

#[test]
fn frames_of_ase_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("water.xyz");
    run("extended_xyz.py", [Path::new("make"), &path]);
    let frames = extended_xyz::read(&path).unwrap();
    assert_eq!(frames.len(), 2);
    for (index, frame) in frames.iter().enumerate() {
        let space = Space { origin: [0.0; 3], sides: [2.0, 3.0, 4.0], periodic: [true, false, true] };
        assert_eq!((frame.space, frame.time), (Some(space), Some(0.5 * index as f64)));
        // ASE writes eight decimals.
        let wanted = [[0.0, 0.0, 0.1], [1.0 / 3.0, 0.0, 0.0], [0.0, 2e-9, -5.0]];
        for (found, wanted) in frame.positions.as_flattened().iter().zip(wanted.as_flattened()) {
            assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
        }
        let values = |name: &str| &frame.columns.iter().find(|column| column.name == name).unwrap().values;
        assert_eq!(values("id"), &ReadValues::Whole(vec![3, 2, 1 + index as i64]));
        assert_eq!(values("velocity"), &ReadValues::Real((0..9).map(f64::from).collect()));
        assert_eq!(values("wet"), &ReadValues::Bool(vec![true, false, true]));
        let species = ["H", "H", "O"].map(str::to_owned).to_vec();
        assert_eq!(values("species"), &ReadValues::Text(species));
    }
}
