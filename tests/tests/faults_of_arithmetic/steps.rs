//! Ranges in steps of 0.

use super::model::{CELL, FIRST, Field, base, stops};
use std::error::Error;
use xca_core::prelude::*;

#[elementary_process]
fn in_steps(cell: &mut Cell<Field>) {
    for k in (0..3).step_by(cell.divisor as usize) {
        cell.total += cell.numbers[k] as Real;
    }
}

/// Rust asks for the step before it knows that the range is empty.
#[elementary_process]
fn in_steps_through_nothing(cell: &mut Cell<Field>) {
    for _ in (3..=cell.index - cell.index).rev().step_by(cell.divisor as usize) {
        cell.total += 1.0;
    }
}

#[helper]
fn counted(step: usize) -> Real {
    let mut count = 0.0;
    for _ in (0..10).step_by(step) {
        count += 1.0;
    }
    count
}

#[elementary_process]
fn in_steps_of_a_helper(cell: &mut Cell<Field>) {
    cell.total = counted(cell.divisor as usize * 3);
}

const NO_STEP: usize = 0;

#[elementary_process]
fn in_steps_of_a_constant(cell: &mut Cell<Field>) {
    if cell.divisor == 0 {
        for k in (0..cell.index).step_by(NO_STEP) {
            cell.total += k as Real;
        }
    }
}

#[test]
fn a_range_in_steps_of_0() -> Result<(), Box<dyn Error>> {
    let no_step = "assertion failed: step != 0";
    stops(base(FIRST).process(in_steps), CELL, None, no_step)?;
    stops(base(FIRST).process(in_steps_through_nothing), CELL, None, no_step)?;
    stops(base(FIRST).process(in_steps_of_a_helper), CELL, None, no_step)?;
    stops(base(FIRST).process(in_steps_of_a_constant), CELL, None, no_step)
}
