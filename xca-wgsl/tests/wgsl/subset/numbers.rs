//! Numbers and vectors of all types.

use super::state::{GRAVITY, INFINITE, LIMIT, LIMITS, LOWEST, MASK, STEPS, Settings, State, WEIGHTS};
use crate::common::{accepted, function, written};
use xca_core::prelude::*;

#[elementary_process]
fn bytes(cell: &mut Cell<State>) {
    let mut n = 0;
    n += cell.byte;
    n = n * 3 - 1;
    n <<= 2;
    n ^= !cell.byte;
    let shifted = cell.byte << (cell.unsigned & 3);
    let half = n >> 1;
    n = n.wrapping_add(shifted).wrapping_mul(half).wrapping_sub(1);
    n %= 7;
    n |= 8;
    n &= 0x7f;
    let count = n.count_ones();
    cell.byte = (n + count as u8).min(250).max(3);
    cell.colour = Vector4::new(n, 1, 2, cell.byte) + cell.colour;
}

#[test]
fn u8_wraps() {
    accepted::<bytes>();
    let text = function(&written::<bytes>(Precision::F64), "bytes");
    assert!(text.contains("    n = (n + cell.byte) & 0xffu;\n"), "{text}");
    assert!(
        text.contains("    n = ((n * 3u) - 1u) & 0xffu;\n") || text.contains("& 0xffu) - 1u) & 0xffu;\n"),
        "{text}"
    );
    assert!(
        text.contains("    n = n ^ (~cell.byte & 0xffu);\n") || text.contains("n ^ ((~cell.byte) & 0xffu)"),
        "{text}"
    );
    assert!(text.contains("(cell.byte << (cell.unsigned_ & 7u))") || text.contains("& 7u"), "{text}");
}

#[elementary_process]
fn integers(cell: &mut Cell<State>) {
    let mut a = cell.signed;
    a = -a + LOWEST;
    a = a.abs() % 5 - 2147483647;
    let b = -2147483648;
    if a == b {
        a = !a;
    }
    a >>= 3;
    a <<= cell.byte;
    let c = a as u32 ^ MASK;
    let d = (c as u8) as i32 + (a > 0) as i32;
    cell.unsigned = c.wrapping_mul(747796405).wrapping_add(2891336453) >> 22;
    cell.signed = (d.clamp(-5, 5) + a.max(b).count_ones() as i32) / 2;
    cell.grid = STEPS[cell.unsigned as usize % 2] - cell.grid;
    cell.grid.x += cell.index().x + 1;
}

#[test]
fn integers_are_rusts() {
    accepted::<integers>();
    let text = function(&written::<integers>(Precision::F32), "integers");
    assert!(text.contains("let b: i32 = i32(-2147483648);"), "{text}");
    assert!(text.contains("a = a << (cell.byte & 31u);"), "{text}");
    assert!(text.contains("STEPS[cell.unsigned % 2u]"), "{text}");
}

#[elementary_process]
fn floats(cell: &mut Cell<State>, p: &Settings) {
    let mut x = cell.real * p.scale - 0.5;
    x = x.min(LIMIT).max(-1e-5).clamp(-2.0, 2.0);
    let y = (x * x + 1.0).sqrt().floor() + x.ceil().abs() - x.trunc();
    let single = y as f32;
    let double = x as f64 + 0.1;
    cell.single = single + 1.5 - cell.signed as f32;
    cell.double = double / 3.0 + cell.unsigned as f64;
    let n = y as i32 + (y as u8) as i32 - (y as u32) as i32;
    let mut count = 0.0;
    for i in 0..3 {
        count += WEIGHTS[i] * (n as Real);
    }
    cell.real = if count > 1.0 / 3.0 && count != -0.0 { count } else { -y };
    cell.single = cell.single * 0.1 + cell.double as f32;
    cell.real += 2.5 as Real;
}

#[test]
fn floats_keep_their_types() {
    accepted::<floats>();
    let text = function(&written::<floats>(Precision::F32), "floats");
    assert!(text.contains("let single: f32 = y;"), "{text}");
    assert!(text.contains("let double: f64 = f64(x) + 0.1lf;"), "{text}");
    assert!(text.contains("var count: Real = 0.0f;"), "{text}");
    assert!(text.contains("saturate_u8_from_real(y)"), "{text}");
    // naga's `!=` of floats is false for NaN.
    assert!(text.contains("!(count == (-0.0f))"), "{text}");
    assert!(text.contains("cell.real = select(-y, count, "), "{text}");
}

#[elementary_process]
fn edges(cell: &mut Cell<State>) {
    let x = cell.real;
    let y = cell.velocity.x;
    let least = x.min(y);
    let most = x.max(y);
    cell.signed = x as i32 ^ (least as i32).abs() ^ y as u32 as i32 ^ (x as u8) as i32;
    cell.unsigned = (x as u32) ^ (cell.unsigned << cell.byte) ^ (cell.signed >> (cell.byte + 25)) as u32;
    cell.byte = y as u8 ^ (cell.byte << (cell.byte & 15));
    cell.single = most as f32;
    cell.double = x.clamp(-1.5, 1e30) as f64 + cell.signed as f64;
    if x < INFINITE && !(y > -INFINITE) {
        cell.real = -0.0;
    } else if least != most {
        cell.real = x / y + LIMITS[(cell.unsigned % 3) as usize];
    }
}

#[test]
fn edges_of_types() {
    accepted::<edges>();
}

#[elementary_process]
fn vectors(cell: &mut Cell<State>, p: &Settings) {
    let mut v = cell.velocity + GRAVITY * 0.1 - 2.0 * p.wind;
    v *= 0.5;
    v += Vector3::splat(1.0);
    v -= p.wind / 3.0;
    v /= p.scale;
    v.z = -v.z;
    let w = Vector3::new(v.y, 0.0, 1.0).cross(-v);
    let d = v.dot(w) + (v - w).length_squared() + v.length();
    if v == w || v != -w {
        v.x = d;
    }
    cell.velocity = v;
    cell.velocity.y += 1.0;
}

#[test]
fn vectors_are_added_in_order() {
    accepted::<vectors>();
    let shader = written::<vectors>(Precision::F64);
    let dot = function(&shader, "dot_vec3_real");
    assert!(dot.contains("return a.x * b.x + a.y * b.y + a.z * b.z;"), "{dot}");
}
