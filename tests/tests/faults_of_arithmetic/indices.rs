//! An index beyond an array of a cell.

use super::model::{CELL, FIRST, Field, Ground, Plan, TABLE, base, beyond, stops};
use std::error::Error;
use xca_core::prelude::*;

#[helper]
fn picked(numbers: [i32; 3], index: u32) -> i32 {
    numbers[index as usize]
}

#[helper]
fn share(p: &Plan, index: u32) -> Real {
    p.weights[index as usize]
}

#[elementary_process]
fn own(cell: &mut Cell<Field>) {
    cell.total += cell.numbers[cell.index as usize] as Real;
}

#[elementary_process]
fn own_that_is_written(cell: &mut Cell<Field>) {
    cell.numbers[0] = 7;
    cell.total = cell.numbers[cell.index as usize] as Real;
}

#[elementary_process]
fn written(cell: &mut Cell<Field>) {
    cell.flows[cell.index as usize].y = 1.0;
}

#[elementary_process]
fn at_a_neighbour(cell: &mut Cell<Field>) {
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        sum += cell.neighbour(n).flows[cell.neighbour(n).index as usize].x;
    }
    cell.total = sum;
}

#[elementary_process]
fn at_a_named_neighbour(cell: &mut Cell<Field>) {
    let left = cell.neighbour(1);
    if left.marks[cell.index as usize] {
        cell.index += 1;
    }
}

#[elementary_process]
fn in_a_variable(cell: &mut Cell<Field>) {
    let numbers = [cell.index; 2];
    cell.total = numbers[cell.index as usize] as Real;
}

#[elementary_process]
fn in_a_table(cell: &mut Cell<Field>) {
    cell.total = TABLE[cell.index as usize + 1] as Real;
}

#[elementary_process]
fn of_a_parameter(cell: &mut Cell<Field>, p: &Plan) {
    cell.total = p.weights[cell.index as usize];
}

#[elementary_process]
fn of_a_truth(cell: &mut Cell<Field>, p: &Plan) {
    if p.wanted[cell.index as usize] {
        cell.total = 1.0;
    }
}

#[elementary_process]
fn by_a_state(cell: &mut Cell<Field>) {
    if cell.index == 3 {
        cell.ground = Ground::Water;
    }
    cell.total = cell.flows[cell.ground as usize].x;
}

#[elementary_process]
fn by_a_number_below_zero(cell: &mut Cell<Field>) {
    cell.total = cell.numbers[(cell.divisor - 1) as usize] as Real;
}

#[elementary_process]
fn in_a_helper(cell: &mut Cell<Field>) {
    cell.total = picked(cell.numbers, cell.index) as Real;
}

#[elementary_process]
fn of_a_parameter_in_a_helper(cell: &mut Cell<Field>, p: &Plan) {
    cell.total = share(p, cell.index);
}

/// Without the fault the loop has no end.
#[elementary_process]
fn in_a_loop(cell: &mut Cell<Field>) {
    if cell.index > 1 {
        let mut k = 0;
        while cell.numbers[k] < 100 {
            k += 1;
        }
    }
}

#[test]
fn an_index_beyond_an_array_of_a_cell() -> Result<(), Box<dyn Error>> {
    let at = |builder, message: String| stops(builder, CELL, None, &message);
    at(base(FIRST).process(own), beyond(3, 3))?;
    at(base(FIRST).process(own_that_is_written), beyond(3, 3))?;
    at(base(FIRST).process(written), beyond(2, 3))?;
    at(base(FIRST).process(at_a_named_neighbour), beyond(2, 3))?;
    at(base(FIRST).process(in_a_variable), beyond(2, 3))?;
    at(base(FIRST).process(in_a_table), beyond(4, 4))?;
    at(base(FIRST).process(of_a_parameter), beyond(3, 3))?;
    at(base(FIRST).process(of_a_truth), beyond(2, 3))?;
    at(base(FIRST).process(by_a_state), beyond(2, 2))?;
    at(base(FIRST).process(by_a_number_below_zero), beyond(3, u32::MAX))?;
    at(base(FIRST).process(in_a_helper), beyond(3, 3))?;
    at(base(FIRST).process(of_a_parameter_in_a_helper), beyond(3, 3))?;
    at(base(FIRST).process(in_a_loop), beyond(3, 3))?;
    // The first cell sees one in the second layer.
    stops(base(FIRST).process(at_a_neighbour), [0; 3], None, &beyond(2, 6))
}
