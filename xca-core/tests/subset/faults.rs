//! Impossible states.

use crate::common::{failure, single_cell, step};
use xca_core::prelude::*;

const TOO_HOT: u32 = 7;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct State {
    heat: Real,
    n: u32,
}

#[elementary_process]
fn guard(cell: &mut Cell<State>) {
    if cell.heat > 100.0 {
        cell.fault(TOO_HOT, cell.heat);
        cell.fault(TOO_HOT + 1, 0.0);
    }
    match cell.n {
        1 => cell.fault(cell.n, 0.5),
        _ => {}
    }
    cell.n += 1;
}

#[test]
fn the_first_fault_ends_the_run() {
    let hot = State { heat: 101.5, n: 1 };
    let model = single_cell(hot).process(guard).fault_text(TOO_HOT, "the lava boils");
    let model = model.build().expect("right");
    let error = step::<State>(&model, Precision::F64).expect_err("must fail").to_string();
    assert!(error.contains("step 1") && error.contains("the lava boils"), "{error}");
    assert!(error.contains("guard") && error.contains("101.5") && error.contains("[0, 0, 0]"), "{error}");
    let error = failure(guard, State { heat: 0.0, n: 1 });
    assert!(error.contains("0.5"), "{error}");
    let fine = single_cell(State { heat: 100.0, n: 5 }).process(guard).build().expect("right");
    assert_eq!(step::<State>(&fine, Precision::F32).expect("succeeds"), [State { heat: 100.0, n: 6 }]);
}

#[elementary_process]
fn beyond(cell: &mut Cell<State>) {
    cell.heat = cell.neighbour(cell.n as usize).heat;
}

#[test]
fn a_neighbour_that_there_is_not_is_a_fault() {
    let error = failure(beyond, State { heat: 1.0, n: 1 });
    assert!(error.contains("asks for neighbour 1"), "{error}");
}
