//! Constants and parameters of every type.

use crate::common::{PRECISIONS, run, single_cell, step};
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Results {
    byte: u8,
    signed: i32,
    unsigned: u32,
    single: f32,
    real: Real,
    double: f64,
    vector: Vector3<Real>,
}

mod numbers {
    use xca_core::prelude::*;

    pub(crate) const FIVE: u8 = 5;
    pub(crate) const SIX: u8 = 6;
    pub(crate) const LOW: i32 = -40;
    pub(crate) const MASK: u32 = 0xF0F0;
    pub(crate) const STEPS: usize = 3;
    pub(crate) const PERIODIC: bool = true;
    pub(crate) const SINGLE: f32 = 0.1;
    pub(crate) const TENTH: Real = 0.1;
    pub(crate) const GRAVITY: Vector3<Real> = Vector3::new(0.0, 0.0, -9.75);
    pub(crate) const WEIGHTS: [Real; 3] = [0.25, 0.5, 0.25];
    pub(crate) const MOVES: [Vector2<i32>; 2] = [Vector2::new(1, 0), Vector2::new(0, -1)];
    pub(crate) const TABLE: [[u8; 2]; 2] = [[1, 2], [3, 4]];
}

use numbers::{FIVE, WEIGHTS};

static SHIFT: u32 = 4;

#[elementary_process]
fn use_constants(cell: &mut Cell<Results>) {
    cell.byte = FIVE + numbers::TABLE[1][0];
    cell.signed = numbers::LOW + numbers::MOVES[1].y + i32::MAX / 1000;
    cell.unsigned = numbers::MASK >> SHIFT;
    cell.single = numbers::SINGLE * 3.0;
    cell.real = numbers::TENTH * 3.0;
    cell.vector = numbers::GRAVITY * 2.0;
    for i in 0..numbers::STEPS {
        cell.vector.x += WEIGHTS[i] * (i as Real);
    }
    if numbers::PERIODIC {
        cell.vector.y = std::f64::consts::PI;
    }
}

#[test]
fn constants_of_every_type() {
    for precision in PRECISIONS {
        let model = single_cell(Results::default()).process(use_constants).build().expect("right");
        let after: Results = step(&model, precision).expect("succeeds").remove(0);
        assert_eq!((after.byte, after.signed, after.unsigned), (8, -41 + 2_147_483, 0x0F0F));
        assert_eq!(after.single, 0.1_f32 * 3.0);
        let (tenth, pi) = match precision {
            Precision::F32 => (f64::from(0.1_f32 * 3.0), f64::from(std::f32::consts::PI)),
            Precision::F64 => (0.1 * 3.0, std::f64::consts::PI),
        };
        assert_eq!(after.real, tenth);
        assert_eq!(after.vector, Vector3::new(1.0, pi, -19.5));
    }
}

#[derive(Parameters, Clone, Debug, PartialEq)]
struct Settings {
    signed: i32,
    unsigned: u32,
    single: f32,
    double: f64,
    real: Real,
    wind: Vector3<Real>,
    shift: Vector2<i32>,
    mask: Vector4<u32>,
}

#[elementary_process]
fn use_parameters(cell: &mut Cell<Results>, settings: &Settings) {
    cell.signed = settings.signed + settings.shift.y;
    cell.unsigned = settings.unsigned + settings.mask.w;
    cell.single = settings.single;
    cell.double = settings.double;
    cell.real = settings.real;
    cell.vector = settings.wind;
}

#[test]
fn parameters_of_every_type() {
    let settings = Settings {
        signed: -7,
        unsigned: 4_000_000_000,
        single: 0.1,
        double: 0.1,
        real: 0.1,
        wind: Vector3::new(1.5, 0.1, 3.0),
        shift: Vector2::new(1, -2),
        mask: Vector4::new(1, 2, 3, 4),
    };
    for precision in PRECISIONS {
        let builder = single_cell(Results::default()).parameters(settings.clone());
        let model = builder.process(use_parameters).build().expect("right");
        let after: Results = step(&model, precision).expect("succeeds").remove(0);
        assert_eq!((after.signed, after.unsigned), (-9, 4_000_000_004));
        assert_eq!((after.single, after.double), (0.1, 0.1));
        let tenth = if precision == Precision::F32 { f64::from(0.1_f32) } else { 0.1 };
        assert_eq!(after.real, tenth);
        assert_eq!(after.vector, Vector3::new(1.5, tenth, 3.0));
    }
}

#[elementary_process]
fn match_constants(cell: &mut Cell<Results>) {
    cell.signed = match cell.byte {
        numbers::SIX | 7 => 1,
        FIVE => 2,
        _ => 3,
    };
}

#[test]
fn constants_in_patterns() {
    let after = [4, 5, 6, 7].map(|byte| run(match_constants, Results { byte, ..Results::default() }).signed);
    assert_eq!(after, [3, 2, 1, 1]);
}
