//! Floats: `Real` in the precision of the run, `f32` and `f64` always themselves.

use crate::common::{PRECISIONS, run_in};
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Numbers {
    real: Real,
    single: f32,
    double: f64,
    result: Real,
    count: i32,
}

#[elementary_process]
fn arithmetic(cell: &mut Cell<Numbers>) {
    let x = cell.real;
    let mut y = x * 0.1 + x / 3.0 - 0.7;
    y += x;
    y -= 0.3;
    y *= x;
    y /= 7.0;
    y %= 1.9;
    cell.result = -y + 1e-3;
}

macro_rules! arithmetic_in_rust {
    ($x:expr) => {{
        let x = $x;
        let mut y = x * 0.1 + x / 3.0 - 0.7;
        y += x;
        y -= 0.3;
        y *= x;
        y /= 7.0;
        y %= 1.9;
        -y + 1e-3
    }};
}

/// To the last bit, in the precision of the run.
#[test]
fn real_is_computed_in_the_precision_of_the_run() {
    for x in [0.1, -12.3, 1e9, 5.0_f64.sqrt()] {
        let before = Numbers { real: x, ..Numbers::default() };
        let single: f32 = arithmetic_in_rust!(x as f32);
        let double: f64 = arithmetic_in_rust!(x);
        assert_eq!(run_in(arithmetic, before, Precision::F32).result.to_bits(), f64::from(single).to_bits());
        assert_eq!(run_in(arithmetic, before, Precision::F64).result.to_bits(), double.to_bits());
    }
}

#[elementary_process]
fn methods(cell: &mut Cell<Numbers>) {
    let x = cell.real;
    let a = x.abs().sqrt() + x.floor() * 10.0 + x.ceil() * 100.0 + x.trunc() * 1000.0;
    let b = x.min(0.5).max(-1.5) + x.clamp(-2.0, 2.0);
    cell.result = a - b;
    cell.count = x.floor() as i32;
}

#[test]
fn methods_are_rusts() {
    for x in [-2.25_f64, -0.25, 0.0, 0.25, 6.25] {
        let root = x.abs().sqrt();
        for precision in PRECISIONS {
            let after = run_in(methods, Numbers { real: x, ..Numbers::default() }, precision);
            let a = root + x.floor() * 10.0 + x.ceil() * 100.0 + x.trunc() * 1000.0;
            let b = x.clamp(-1.5, 0.5) + x.clamp(-2.0, 2.0);
            assert_eq!(after.result, a - b, "{x}");
            assert_eq!(after.count, x.floor() as i32);
        }
    }
}

#[elementary_process]
fn extremes(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.max(1.0);
    cell.count = if cell.real != cell.real { 1 } else { 0 };
    cell.single = cell.single.min(0.0);
}

/// `max` and `min` are comparisons, on all engines alike: a receiver that is NaN stays, for nothing is
/// greater.
#[test]
fn comparisons_with_nan_are_fixed() {
    for precision in PRECISIONS {
        let before = Numbers { real: f64::NAN, single: -0.0, ..Numbers::default() };
        let after = run_in(extremes, before, precision);
        assert!(after.result.is_nan());
        assert_eq!(after.count, 1);
        assert!(after.single.is_sign_negative());
    }
}

#[elementary_process]
fn least(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.min(cell.double as Real);
}

#[elementary_process]
fn largest(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.max(cell.double as Real);
}

#[elementary_process]
fn between(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.clamp(cell.double as Real, 1.0);
}

#[elementary_process]
fn size(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.abs();
}

#[elementary_process]
fn rounded_down(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.floor();
}

#[elementary_process]
fn ceiling(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.ceil();
}

#[elementary_process]
fn truncated(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.trunc();
}

#[elementary_process]
fn square_root(cell: &mut Cell<Numbers>) {
    cell.result = cell.real.sqrt();
}

fn same(value: f64, wanted: f64) -> bool {
    value.to_bits() == wanted.to_bits() || (value.is_nan() && wanted.is_nan())
}

/// The table of docs/mathematics.md, with zeros that have signs, infinities and NaN.
#[test]
fn signs_of_zeros_and_nan_are_as_documented() {
    let special = [0.0, -0.0, 0.5, -0.5, 1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for precision in PRECISIONS {
        for a in special {
            for b in special {
                let numbers = Numbers { real: a, double: b, ..Numbers::default() };
                let check = |value: Numbers, wanted: f64| {
                    assert!(same(value.result, wanted), "{a:?} {b:?}: {:?} is not {wanted:?}", value.result);
                };
                check(run_in(least, numbers, precision), if b < a { b } else { a });
                check(run_in(largest, numbers, precision), if a < b { b } else { a });
                let above = if a < b { b } else { a };
                check(run_in(between, numbers, precision), if 1.0 < above { 1.0 } else { above });
                check(run_in(size, numbers, precision), f64::from_bits(a.to_bits() & !(1 << 63)));
                check(
                    run_in(rounded_down, numbers, precision),
                    if a == 0.5 {
                        0.0
                    } else if a == -0.5 {
                        -1.0
                    } else {
                        a
                    },
                );
                check(
                    run_in(ceiling, numbers, precision),
                    if a == 0.5 {
                        1.0
                    } else if a == -0.5 {
                        -0.0
                    } else {
                        a
                    },
                );
                check(
                    run_in(truncated, numbers, precision),
                    if a.abs() == 0.5 { 0.0_f64.copysign(a) } else { a },
                );
                if a != 0.5 {
                    // All others are their own roots.
                    check(run_in(square_root, numbers, precision), if a < 0.0 { f64::NAN } else { a });
                }
            }
        }
    }
}

#[elementary_process]
fn fixed(cell: &mut Cell<Numbers>) {
    cell.single = cell.single / 3.0 + 0.1;
    cell.double = cell.double / 3.0 + 0.1;
    cell.result = cell.single as Real + cell.double as Real;
    let exact = cell.real as f64;
    cell.double += exact * 2.0_f64;
    cell.single += 1.5_f32 * cell.count as f32;
}

#[test]
fn f32_and_f64_stay_themselves() {
    for precision in PRECISIONS {
        let before = Numbers { single: 1.0, double: 1.0, real: 0.25, count: 3, ..Numbers::default() };
        let after = run_in(fixed, before, precision);
        let (single, double) = (1.0_f32 / 3.0 + 0.1, 1.0_f64 / 3.0 + 0.1);
        assert_eq!(after.single, single + 4.5);
        assert_eq!(after.double, double + 0.5);
        let expected = match precision {
            Precision::F32 => f64::from(single + double as f32),
            Precision::F64 => f64::from(single) + double,
        };
        assert_eq!(after.result, expected);
    }
}

#[elementary_process]
fn literals(cell: &mut Cell<Numbers>) {
    let third: Real = 1.0 / 3.0;
    let large = 1.0e300 * cell.real;
    cell.result = third;
    cell.count = if large > 1.0e300 { 1 } else { 0 };
}

/// A literal has the precision of what it is used with; what is too large for `f32` is infinite there.
#[test]
fn literals_follow_the_precision() {
    let before = Numbers { real: 2.0, ..Numbers::default() };
    let single = run_in(literals, before, Precision::F32);
    let double = run_in(literals, before, Precision::F64);
    assert_eq!(single.result, f64::from(1.0_f32 / 3.0));
    assert_eq!(double.result, 1.0 / 3.0);
    assert_eq!((single.count, double.count), (0, 1));
}
