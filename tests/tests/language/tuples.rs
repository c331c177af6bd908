//! Tuples: results of helpers, taken apart by `let`.

use crate::{TestResult, on_all_engines};
use xca_core::prelude::*;
use xca_tests::suite::engines::PRECISIONS;

#[helper]
fn divided(a: i32, b: i32) -> (i32, i32) {
    if b == 0 {
        return (0, a);
    }
    (a / b, a % b)
}

#[helper]
fn ordered(a: i32, b: i32) -> (bool, (i32, i32)) {
    let swapped = b < a;
    if swapped { (swapped, (b, a)) } else { (swapped, (a, b)) }
}

#[helper]
fn extremes(values: [i32; 4]) -> (Vector2<i32>, [i32; 2], u8) {
    let (mut low, mut high, mut count) = (values[0], values[0], 0_u8);
    for value in values {
        low = low.min(value);
        high = high.max(value);
        count += 1;
    }
    (Vector2::new(low, high), [high - low, low], count)
}

/// All of the above in one number.
#[helper]
fn mixed(n: i32) -> i32 {
    let (quotient, rest) = divided(7 * n + 3, n - 2);
    let (_, mut sum) = divided(n, 3);
    let (swapped, pair) = ordered(quotient, rest);
    let (low, high) = pair;
    let (low, high) = (high, low);
    sum += 2 * low + 5 * high;
    if swapped {
        sum += 1000;
    }
    let (ends, range, count): (Vector2<i32>, [i32; 2], u8) = extremes([n, rest, -n, 5]);
    let (a, b) = match n {
        0 => (1, 2),
        1 | 2 => {
            let c = sum * 2;
            (c, c + 1)
        }
        _ => (n, sum),
    };
    sum + ends.x * 7 + ends.y * 11 + range[0] * 13 + range[1] + count as i32 + 3 * a + b
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Numbers {
    n: i32,
    mixed: i32,
    length: Real,
    flat: u32,
}

/// The size of a vector, and whether it lies in a plane.
#[helper]
fn measured(vector: Vector3<Real>) -> (Real, bool) {
    (vector.length(), vector.z == 0.0)
}

#[elementary_process]
fn compute(cell: &mut Cell<Numbers>) {
    cell.mixed = mixed(cell.n);
    let (length, flat) = measured(Vector3::new(3.0, 4.0, (cell.n - 2) as Real));
    cell.length = length;
    cell.flat = flat as u32;
}

#[test]
fn tuples_are_those_of_rust() -> TestResult {
    let model = Model::builder("tuples")
        .extents([16, 1, 1])
        .substates::<Numbers>()
        .process(compute)
        .fill(|site| {
            let [x, ..] = site.cell();
            Numbers { n: x as i32 - 5, ..Numbers::default() }
        })
        .build()?;
    for precision in PRECISIONS {
        on_all_engines(&model, precision, |simulation| {
            let state = simulation.state();
            for (x, n) in (-5..11).enumerate() {
                assert_eq!(state.get(Numbers::MIXED, [x, 0, 0])?, mixed(n), "{n}");
                assert_eq!(state.get(Numbers::FLAT, [x, 0, 0])?, u32::from(n == 2));
            }
            assert_eq!(state.get(Numbers::LENGTH, [7, 0, 0])?, 5.0);
            Ok(())
        })?;
    }
    Ok(())
}
