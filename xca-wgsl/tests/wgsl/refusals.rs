//! What cannot be written is refused with the process, the place and the reason.

use crate::common::refused;
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct State {
    value: Real,
    count: i32,
}

#[elementary_process]
fn pairs(cell: &mut Cell<State>) {
    if (cell.value, cell.count) == (1.0, 2) {
        cell.count = 1;
    }
}

#[test]
fn comparisons_of_tuples() {
    assert_eq!(
        refused::<pairs>().to_string(),
        "the process `pairs` cannot be written in WGSL: a comparison of tuples: compare their parts"
    );
}

const NOTHING: Real = Real::NAN;

#[helper]
fn nothing(x: Real) -> Real {
    x + NOTHING
}

#[elementary_process]
fn not_a_number(cell: &mut Cell<State>) {
    cell.value = nothing(cell.value);
}

#[test]
fn a_problem_in_a_helper_names_it() {
    assert_eq!(
        refused::<not_a_number>().to_string(),
        "the process `not_a_number` cannot be written in WGSL: in `nothing`: NaN as a constant: WGSL cannot write it; \
         report a fault instead"
    );
}

#[helper]
fn even(n: i32) -> bool {
    if n == 0 { true } else { odd(n - 1) }
}

#[helper]
fn odd(n: i32) -> bool {
    if n == 0 { false } else { even(n - 1) }
}

#[elementary_process]
fn recursive(cell: &mut Cell<State>) {
    cell.count = even(cell.count) as i32;
}

#[test]
fn recursion() {
    assert_eq!(
        refused::<recursive>().to_string(),
        "the process `recursive` cannot be written in WGSL: in `even`: the helper `even` calls itself, which WGSL \
         forbids; write a loop"
    );
}
