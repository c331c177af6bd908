//! Whole numbers and truth values.

use crate::common::{failure, run};
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Numbers {
    byte: u8,
    signed: i32,
    unsigned: u32,
    other: i32,
    flag: u8,
}

#[elementary_process]
fn signed(cell: &mut Cell<Numbers>) {
    let a = cell.signed;
    let b = cell.other;
    let mut n = a + b * 3 - a / b;
    n += a % b;
    n -= 1;
    n *= 2;
    n /= 3;
    n %= 1000;
    n ^= 0x55;
    n |= 1 << 9;
    n &= !6;
    n <<= 2;
    n >>= 1;
    n = -n + (a & b) + (a | b) + (a ^ b);
    cell.signed = n;
    cell.other = n.abs().min(77).max(b).clamp(-5, 70);
    cell.unsigned = n.count_ones();
}

fn signed_in_rust(a: i32, b: i32) -> (i32, i32, u32) {
    let mut n = a + b * 3 - a / b;
    n += a % b;
    n -= 1;
    n *= 2;
    n /= 3;
    n %= 1000;
    n ^= 0x55;
    n |= 1 << 9;
    n &= !6;
    n <<= 2;
    n >>= 1;
    n = -n + (a & b) + (a | b) + (a ^ b);
    (n, n.abs().min(77).max(b).clamp(-5, 70), n.count_ones())
}

#[test]
fn signed_numbers_are_rusts() {
    for (a, b) in [(17, 5), (-17, 5), (17, -5), (-17, -5), (0, 1), (100_000, -7)] {
        let after = run(signed, Numbers { signed: a, other: b, ..Numbers::default() });
        assert_eq!((after.signed, after.other, after.unsigned), signed_in_rust(a, b), "{a} {b}");
    }
}

#[elementary_process]
fn unsigned(cell: &mut Cell<Numbers>) {
    let n = cell.unsigned;
    let hashed = n.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let shifted = (hashed >> (n & 7)) ^ (hashed << 3_u8);
    cell.unsigned = shifted.wrapping_sub(n) % 1_000_003 / 2;
    cell.byte = cell.byte.wrapping_add(200).wrapping_mul(3).wrapping_sub(9) ^ (shifted as u8);
}

#[test]
fn unsigned_numbers_wrap_where_asked() {
    for n in [0_u32, 1, 12345, u32::MAX] {
        let after = run(unsigned, Numbers { unsigned: n, byte: 99, ..Numbers::default() });
        let hashed = n.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let shifted = (hashed >> (n & 7)) ^ (hashed << 3);
        assert_eq!(after.unsigned, shifted.wrapping_sub(n) % 1_000_003 / 2);
        assert_eq!(after.byte, 99_u8.wrapping_add(200).wrapping_mul(3).wrapping_sub(9) ^ (shifted as u8));
    }
}

#[elementary_process]
fn casts(cell: &mut Cell<Numbers>) {
    let real = cell.signed as Real * 0.5;
    cell.byte = real as u8;
    cell.unsigned = (cell.signed as u32) ^ (real as i32 as u32);
    cell.other = (real > 0.0) as i32 + cell.byte as i32;
    let index = cell.byte as usize % 3;
    cell.flag = [7, 8, 9][index];
}

#[test]
fn casts_are_rusts() {
    for n in [-700, -3, 0, 5, 700] {
        let after = run(casts, Numbers { signed: n, ..Numbers::default() });
        let real = f64::from(n) * 0.5;
        assert_eq!(after.byte, real as u8);
        assert_eq!(after.unsigned, (n as u32) ^ (real as i32 as u32));
        assert_eq!(after.other, i32::from(real > 0.0) + i32::from(after.byte));
        assert_eq!(after.flag, [7, 8, 9][after.byte as usize % 3]);
    }
}

#[elementary_process]
fn truth(cell: &mut Cell<Numbers>) {
    let a = cell.byte > 1;
    let b: bool = cell.signed != 4;
    let both = a && b;
    let either = a || b;
    let one = a ^ b;
    let strict = a & !b | false;
    let equal = a == b && true;
    let ordered = cell.signed <= 4 && cell.signed >= 3 || cell.signed < -1;
    cell.flag = both as u8
        + 2 * either as u8
        + 4 * one as u8
        + 8 * strict as u8
        + 16 * equal as u8
        + 32 * ordered as u8;
}

#[test]
fn truth_values_are_rusts() {
    for (byte, n) in [(0, 4), (0, 3), (2, 4), (2, -2)] {
        let after = run(truth, Numbers { byte, signed: n, ..Numbers::default() });
        let (a, b) = (byte > 1, n != 4);
        let ordered = (3..=4).contains(&n) || n < -1;
        let expected = [a && b, a || b, a ^ b, a && !b, a == b, ordered];
        let expected: u8 = expected.iter().enumerate().map(|(bit, set)| u8::from(*set) << bit).sum();
        assert_eq!(after.flag, expected);
    }
}

#[elementary_process]
fn increment(cell: &mut Cell<Numbers>) {
    cell.byte += 1;
}

#[elementary_process]
fn divide(cell: &mut Cell<Numbers>) {
    cell.signed /= cell.other;
}

#[elementary_process]
fn look_up(cell: &mut Cell<Numbers>) {
    let table = [1, 2, 3];
    cell.signed = table[cell.unsigned as usize];
}

/// Rust's own panics end the run with an error.
#[test]
fn panics_are_errors_of_the_run() {
    assert_eq!(
        failure(increment, Numbers { byte: 255, ..Numbers::default() }),
        "step 1: the code of `increment` panicked in cell [0, 0, 0]: attempt to add with overflow"
    );
    assert_eq!(
        failure(divide, Numbers::default()),
        "step 1: the code of `divide` panicked in cell [0, 0, 0]: attempt to divide by zero"
    );
    assert_eq!(
        failure(look_up, Numbers { unsigned: 3, ..Numbers::default() }),
        "step 1: the code of `look_up` panicked in cell [0, 0, 0]: index out of bounds: the len is 3 but the index is 3"
    );
    assert_eq!(run(look_up, Numbers { unsigned: 2, ..Numbers::default() }).signed, 3);
}
