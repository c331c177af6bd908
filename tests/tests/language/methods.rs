//! Methods of numbers, vectors and arrays: on every engine, against those of Rust.

use crate::{TestResult, on_all_engines};
use xca_core::prelude::*;
use xca_tests::suite::engines::PRECISIONS;

/// Signs of zero, halves, large and small numbers, infinities, NaN.
const FLOATS: [f64; 24] = [
    0.0,
    -0.0,
    0.25,
    -0.25,
    0.5,
    -0.5,
    1.5,
    -1.5,
    2.5,
    -2.5,
    3.0,
    -3.0,
    0.3,
    7.75,
    -7.75,
    8_388_607.5,
    -8_388_607.5,
    16_777_216.0,
    1.0e-30,
    -3.0e30,
    0.499_999_97,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Floats {
    x: Real,
    y: Real,
    round: Real,
    fract: Real,
    recip: Real,
    signum: Real,
    copysign: Real,
    rem_euclid: Real,
    div_euclid: Real,
    remainder: Real,
    classes: u32,
}

#[elementary_process]
fn of_floats(cell: &mut Cell<Floats>) {
    let (x, y) = (cell.x, cell.y);
    cell.round = x.round();
    cell.fract = x.fract();
    cell.recip = x.recip();
    cell.signum = x.signum();
    cell.copysign = x.copysign(y);
    cell.rem_euclid = x.rem_euclid(y);
    cell.div_euclid = x.div_euclid(y);
    cell.remainder = x % y;
    let mut classes = 0;
    if x.is_nan() {
        classes += 1;
    }
    if x.is_finite() {
        classes += 2;
    }
    if x.is_infinite() {
        classes += 4;
    }
    if x.is_sign_negative() {
        classes += 8;
    }
    cell.classes = classes;
}

/// What Rust gives in one precision. A NaN counts as positive.
macro_rules! of_rust {
    ($x:expr, $y:expr) => {{
        let (x, y) = ($x, $y);
        let positive = if y.is_nan() { y.abs() } else { y };
        let negative = !x.is_nan() && x.is_sign_negative();
        let classes = u32::from(x.is_nan())
            + 2 * u32::from(x.is_finite())
            + 4 * u32::from(x.is_infinite())
            + 8 * u32::from(negative);
        let values = [
            x.round(),
            x.fract(),
            x.recip(),
            x.signum(),
            x.copysign(positive),
            x.rem_euclid(y),
            x.div_euclid(y),
            x % y,
        ];
        (values.map(f64::from), classes)
    }};
}

#[test]
fn methods_of_floats_are_those_of_rust() -> TestResult {
    let size = FLOATS.len();
    let model = Model::builder("floats")
        .extents([size, size, 1])
        .substates::<Floats>()
        .process(of_floats)
        .fill(|site| {
            let [x, y, _] = site.cell();
            Floats { x: FLOATS[x], y: FLOATS[y], ..Floats::default() }
        })
        .build()?;
    for precision in PRECISIONS {
        on_all_engines(&model, precision, |simulation| {
            let state = simulation.state();
            let results = [
                Floats::ROUND,
                Floats::FRACT,
                Floats::RECIP,
                Floats::SIGNUM,
                Floats::COPYSIGN,
                Floats::REM_EUCLID,
                Floats::DIV_EUCLID,
                Floats::REMAINDER,
            ];
            for (x, y) in (0..size).flat_map(|x| (0..size).map(move |y| (x, y))) {
                let (values, classes) = match precision {
                    Precision::F32 => of_rust!(FLOATS[x] as f32, FLOATS[y] as f32),
                    Precision::F64 => of_rust!(FLOATS[x], FLOATS[y]),
                };
                for (wanted, substate) in values.into_iter().zip(results) {
                    let found = state.get(substate, [x, y, 0])?;
                    let same = wanted.to_bits() == found.to_bits() || wanted.is_nan() && found.is_nan();
                    assert!(
                        same,
                        "{precision} {substate:?} of {} {}: {wanted} {found}",
                        FLOATS[x], FLOATS[y]
                    );
                }
                assert_eq!(state.get(Floats::CLASSES, [x, y, 0])?, classes, "{}", FLOATS[x]);
            }
            Ok(())
        })?;
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Integers {
    a: i32,
    b: i32,
    rem: i32,
    div: i32,
    sign: i32,
    unsigned: u32,
    byte: u8,
}

#[elementary_process]
fn of_integers(cell: &mut Cell<Integers>) {
    cell.rem = cell.a.rem_euclid(cell.b);
    cell.div = cell.a.div_euclid(cell.b);
    cell.sign = cell.a.signum() * 10 + (-cell.b).signum();
    let size = cell.b.abs() as u32;
    cell.unsigned = 1000_u32.rem_euclid(size) + 10_000 * 1000_u32.div_euclid(size);
    cell.byte = (cell.a as u8).rem_euclid(7) + [cell.a, 1, 2].len() as u8;
}

#[test]
fn methods_of_integers_are_those_of_rust() -> TestResult {
    let number = |i: usize| [-9, -8, -3, -1, 1, 2, 3, 8, 11, 2_147_483_647][i];
    let model = Model::builder("integers")
        .extents([10, 10, 1])
        .substates::<Integers>()
        .process(of_integers)
        .fill(move |site| {
            let [x, y, _] = site.cell();
            Integers { a: number(x), b: number(y), ..Integers::default() }
        })
        .build()?;
    on_all_engines(&model, Precision::F64, |simulation| {
        let state = simulation.state();
        for (x, y) in (0..10).flat_map(|x| (0..10).map(move |y| (x, y))) {
            let (cell, a, b) = ([x, y, 0], number(x), number(y));
            assert_eq!(state.get(Integers::REM, cell)?, a.rem_euclid(b), "{a} {b}");
            assert_eq!(state.get(Integers::DIV, cell)?, a.div_euclid(b), "{a} {b}");
            assert_eq!(state.get(Integers::SIGN, cell)?, a.signum() * 10 - b.signum(), "{a} {b}");
            let size = b.unsigned_abs();
            assert_eq!(state.get(Integers::UNSIGNED, cell)?, 1000 % size + 10_000 * (1000 / size));
            assert_eq!(state.get(Integers::BYTE, cell)?, (a as u8) % 7 + 3);
        }
        Ok(())
    })
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Vectors {
    v: Vector3<Real>,
    w: Vector3<Real>,
    unit: Vector3<Real>,
    low: Vector3<Real>,
    high: Vector3<Real>,
    size: Vector3<Real>,
    distance: Real,
    literals: Real,
    whole: Vector2<i32>,
}

#[elementary_process]
fn of_vectors(cell: &mut Cell<Vectors>) {
    cell.unit = cell.v.normalize();
    cell.low = cell.v.min(cell.w);
    cell.high = cell.v.max(cell.w).clamp(Vector3::splat(-2.0), Vector3::splat(2.0));
    cell.size = cell.v.abs();
    cell.distance = cell.v.distance(cell.w);
    // The type of the receiver follows from what the value is used for.
    let two = 2.0;
    cell.literals = two.sqrt() + (2.0).powi(3) + Vector3::new(0.0, 3.0, 4.0).length() + (0.5).max(cell.v.x);
    cell.whole = Vector2::new(-3, cell.v.x as i32).abs();
}

#[test]
fn methods_of_vectors() -> TestResult {
    let value = |x: usize| 0.75 * x as f64 - 4.0;
    let model = Model::builder("vectors")
        .extents([12, 1, 1])
        .substates::<Vectors>()
        .process(of_vectors)
        .fill(move |site| {
            let [x, ..] = site.cell();
            Vectors {
            v: Vector3::new(value(x), 1.0, -value(x + 2)),
            w: Vector3::new(0.5, value(x), -1.0),
            ..Vectors::default()
        }
        })
        .build()?;
    for precision in PRECISIONS {
        on_all_engines(&model, precision, |simulation| {
            let state = simulation.state();
            for x in 0..12 {
                let cell = [x, 0, 0];
                let (v, w) = (state.get(Vectors::V, cell)?, state.get(Vectors::W, cell)?);
                let close = if precision == Precision::F32 { 1e-6 } else { 1e-15 };
                assert!((state.get(Vectors::UNIT, cell)? - v / v.length()).length() < close);
                assert!((state.get(Vectors::DISTANCE, cell)? - (v - w).length()).abs() < 10.0 * close);
                let low = Vector3::new(v.x.min(w.x), v.y.min(w.y), v.z.min(w.z));
                assert_eq!(state.get(Vectors::LOW, cell)?, low);
                let high = Vector3::new(v.x.max(w.x), v.y.max(w.y), v.z.max(w.z));
                assert_eq!(state.get(Vectors::HIGH, cell)?, high.map(|lane| lane.clamp(-2.0, 2.0)));
                assert_eq!(state.get(Vectors::SIZE, cell)?, v.map(f64::abs));
                let literals = 2_f64.sqrt() + 8.0 + 5.0 + v.x.max(0.5);
                assert!((state.get(Vectors::LITERALS, cell)? - literals).abs() < 20.0 * close);
                assert_eq!(state.get(Vectors::WHOLE, cell)?, Vector2::new(3, (v.x as i32).abs()));
            }
            Ok(())
        })?;
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Angle {
    x: Real,
    power: Real,
    degrees: Real,
    radians: Real,
    wave: Real,
}

/// As ordinary code it computes the same.
#[helper]
fn wave(x: Real) -> Real {
    let two = 2.0;
    let v = Vector3::new(x, -1.0, x * x);
    two.sqrt() * x.sin() + v.abs().normalize().distance(v.min(-v)) + (0.5).exp().min(x)
}

#[elementary_process]
fn of_functions(cell: &mut Cell<Angle>) {
    cell.power = cell.x.powi(13) + cell.x.powi(-2) + cell.x.powi(0);
    cell.degrees = cell.x.to_degrees();
    cell.radians = cell.x.to_radians();
    cell.wave = wave(cell.x);
}

#[test]
fn whole_powers_and_angles() -> TestResult {
    let model = Model::builder("angles")
        .extents([9, 1, 1])
        .substates::<Angle>()
        .process(of_functions)
        .fill(|site| {
            let [x, ..] = site.cell();
            Angle { x: 0.25 * (x as f64 + 1.0), ..Angle::default() }
        })
        .build()?;
    for precision in PRECISIONS {
        on_all_engines(&model, precision, |simulation| {
            let state = simulation.state();
            for i in 0..9 {
                let x = state.get(Angle::X, [i, 0, 0])?;
                let power = x.powi(13) + 1.0 / (x * x) + 1.0;
                let close = if precision == Precision::F32 { 1e-6 } else { 1e-14 };
                assert!((state.get(Angle::POWER, [i, 0, 0])? / power - 1.0).abs() < close, "{x}");
                assert!((state.get(Angle::DEGREES, [i, 0, 0])? / x.to_degrees() - 1.0).abs() < close);
                assert!((state.get(Angle::RADIANS, [i, 0, 0])? / x.to_radians() - 1.0).abs() < close);
                if precision == Precision::F64 {
                    assert_eq!(state.get(Angle::WAVE, [i, 0, 0])?.to_bits(), wave(x).to_bits());
                }
            }
            Ok(())
        })?;
    }
    Ok(())
}
