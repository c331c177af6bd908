//! Arrays and helpers.

use super::state::{Settings, State};
use crate::common::{accepted, function, written};
use xca_core::prelude::*;

#[elementary_process]
fn arrays(cell: &mut Cell<State>) {
    let mut table = [0; 4];
    let mut fields = [[0.5; 2]; 3];
    let mut pair = [Vector3::splat(0.0), cell.velocity];
    for i in 0..4 {
        table[i] = cell.signed + i as i32;
        table[(i + 1) % 4] += 2;
    }
    fields[1][0] = cell.real;
    fields[2] = [1.0, 2.0];
    pair[0].y += fields[1][0];
    pair[1] = pair[0];
    let copy = fields;
    cell.signed = table[3] + [1, 2, 3][cell.byte as usize % 3];
    cell.real = copy[1][(cell.unsigned % 2) as usize];
    cell.velocity = pair[1];
}

#[test]
fn arrays_and_places() {
    accepted::<arrays>();
    let text = function(&written::<arrays>(Precision::F64), "arrays");
    assert!(text.contains("for (var i: u32 = 0u; i < 4u; i += 1u) {"), "{text}");
    assert!(text.contains("fields[1u][0u] = cell.real;"), "{text}");
}

#[helper]
fn square(x: Real) -> Real {
    x * x
}

#[helper]
fn hypotenuse(a: Real, b: Real, p: &Settings) -> Real {
    if a < 0.0 {
        return p.scale;
    }
    (square(a) + square(b)).sqrt()
}

#[helper]
fn search(limit: u32, space: &Space) -> u32 {
    let mut n = space.step();
    loop {
        n += 1;
        if n > limit {
            return n;
        }
    }
}

#[helper]
fn sign(x: i32) -> i32 {
    match x {
        0 => 0,
        1..=2147483647 => 1,
        _ => -1,
    }
}

mod elsewhere {
    use xca_core::prelude::*;

    #[helper]
    pub(super) fn square(x: i32) -> i32 {
        x * x
    }
}

#[elementary_process]
fn helpers(cell: &mut Cell<State>, p: &Settings, space: &Space) {
    cell.real = hypotenuse(cell.real, space.side(), p);
    cell.unsigned = search(10, space) + cell.index().y as u32;
    cell.signed = sign(cell.signed) + elsewhere::square(space.extents().x);
    square(1.0);
}

#[test]
fn helpers_come_along() {
    accepted::<helpers>();
    let shader = written::<helpers>(Precision::F64);
    assert!(function(&shader, "search").ends_with("    return u32();\n}\n"));
    assert_eq!(shader.source.matches("fn square").count(), 2);
    assert!(shader.source.contains("fn square_2("));
}
