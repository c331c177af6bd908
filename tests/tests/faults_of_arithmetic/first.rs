//! Of several things that go wrong the first one is told, and what is right goes on.

use super::model::{CELL, FIRST, Field, Plan, TABLE, base};
use std::error::Error;
use xca_core::prelude::*;
use xca_core::{Fault, ModelBuilder};
use xca_tests::suite::engines::{self, assert_same_fault, assert_same_runs};

#[elementary_process]
fn report_first(cell: &mut Cell<Field>) {
    if cell.divisor < 1 {
        cell.fault(5, 1.5);
        cell.numbers[cell.index as usize] = 12 / cell.divisor;
    }
}

/// Neighbour first, then the index, which has a branch of its own.
#[elementary_process]
fn neighbour_first(cell: &mut Cell<Field>) {
    let n = if cell.divisor < 1 { 99 } else { 1 };
    cell.total = cell.neighbour(n).numbers[match cell.divisor {
        0 => TABLE[cell.index as usize + 9] as usize,
        _ => 1,
    }] as Real;
}

/// The index is looked at only where it is right.
#[elementary_process]
fn only_where_it_is_right(cell: &mut Cell<Field>) {
    if cell.index < 3 && cell.numbers[cell.index as usize] > 0 {
        cell.total = 1.0;
    }
    if cell.index > 2 || cell.numbers[cell.index as usize] == 0 {
        cell.total = 2.0;
    }
    cell.total = if cell.index < 3 { cell.numbers[cell.index as usize] as Real } else { -1.0 };
}

/// Indices of which no engine has any doubt.
#[elementary_process]
fn always_right(cell: &mut Cell<Field>, p: &Plan) {
    let last = cell.index % 3;
    let mut sum = p.weights[last as usize] + TABLE[(last + 1) as usize] as Real;
    for k in 0..3 {
        sum += p.weights[k] * cell.numbers[k] as Real;
    }
    for n in 1..cell.neighbour_count() {
        sum += cell.neighbour(n).flows[(n - 1) % 2].y;
    }
    cell.numbers[(cell.index & 1) as usize] = cell.divisor / 3 + 7 % (last as i32 + 1);
    cell.total = sum + p.weights[cell.ground as usize];
    cell.marks[p.wanted[1] as usize] = true;
}

/// Of several things that go wrong in a cell the first one is told.
#[test]
fn the_first_of_a_cell() -> Result<(), Box<dyn Error>> {
    let engines = engines::all()?;
    let fault = |builder: ModelBuilder| -> Result<Fault, Box<dyn Error>> {
        let error = assert_same_fault(&builder.build()?, &engines, RunOptions::default(), 1);
        let message = error.to_string();
        let RunError::Fault { fault, .. } = error else { return Err(message.into()) };
        Ok(fault)
    };
    let reported = Fault::Reported { process: "report_first", cell: CELL, label: None, code: 5, value: 1.5 };
    assert_eq!(fault(base(FIRST).process(report_first))?, reported);
    let beyond = Fault::BeyondNeighbourhood { process: "neighbour_first", cell: CELL, index: 99, size: 7 };
    assert_eq!(fault(base(FIRST).process(neighbour_first))?, beyond);
    Ok(())
}

#[test]
fn what_is_right_goes_on() -> Result<(), Box<dyn Error>> {
    let engines = engines::all()?;
    let model = base(FIRST).process(only_where_it_is_right).process(always_right).build()?;
    for precision in engines::PRECISIONS {
        assert_same_runs(&model, &engines, RunOptions { precision, seed: 0 }, 3)?;
    }
    Ok(())
}
