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

#[elementary_process]
fn rows(cell: &mut Cell<State>) {
    let all = [(cell.count, 1), (2, cell.count)];
    if all == [(1, 1), (2, 1)] {
        cell.count = 1;
    }
}

#[test]
fn comparisons_of_tuples() {
    let message = |name: &str| {
        format!("the process `{name}` cannot be written in WGSL: a comparison of tuples: compare their parts")
    };
    assert_eq!(refused::<pairs>().to_string(), message("pairs"));
    assert_eq!(refused::<rows>().to_string(), message("rows"));
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
