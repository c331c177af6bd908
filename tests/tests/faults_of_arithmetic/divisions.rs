//! A division of a cell.

use super::model::{CELL, FIRST, Field, Ground, Plan, base, stops};
use std::error::Error;
use xca_core::prelude::*;

#[helper]
fn halves(value: i32, divisor: i32) -> i32 {
    value / divisor
}

#[elementary_process]
fn divided(cell: &mut Cell<Field>) {
    cell.total = (12 / cell.divisor) as Real;
}

#[elementary_process]
fn divided_with_a_remainder(cell: &mut Cell<Field>) {
    cell.numbers[1] %= cell.divisor;
}

#[elementary_process]
fn bytes_divided(cell: &mut Cell<Field>) {
    cell.byte /= cell.byte;
    cell.total = 7.0;
}

#[elementary_process]
fn unsigned_remainder(cell: &mut Cell<Field>) {
    cell.index = 7 % cell.index;
}

#[elementary_process]
fn divided_with_overflow(cell: &mut Cell<Field>, p: &Plan) {
    cell.total = (p.least / cell.divisor) as Real;
}

#[elementary_process]
fn remainder_with_overflow(cell: &mut Cell<Field>, p: &Plan) {
    cell.total = (p.least % cell.divisor) as Real;
}

#[elementary_process]
fn vectors_divided(cell: &mut Cell<Field>) {
    cell.pair = cell.pair / cell.divisor;
}

#[elementary_process]
fn divided_in_a_helper(cell: &mut Cell<Field>) {
    cell.total = halves(5, cell.divisor) as Real;
}

/// The right-hand side comes before the place, and a report before both.
#[elementary_process]
fn in_order(cell: &mut Cell<Field>) {
    cell.numbers[cell.index as usize] = 12 / cell.divisor;
}

#[test]
fn a_division_of_a_cell() -> Result<(), Box<dyn Error>> {
    let by_zero = "attempt to divide by zero";
    let no_remainder = "attempt to calculate the remainder with a divisor of zero";
    stops(base(FIRST).process(divided), CELL, None, by_zero)?;
    stops(base(FIRST).process(divided_with_a_remainder), CELL, None, no_remainder)?;
    stops(base(FIRST).process(bytes_divided), CELL, None, by_zero)?;
    stops(base(FIRST).process(vectors_divided), CELL, None, by_zero)?;
    stops(base(FIRST).process(divided_in_a_helper), CELL, None, by_zero)?;
    stops(base(FIRST).process(in_order), CELL, None, by_zero)?;
    let fill = |divisor, index| {
        base(FIRST).fill(move |site| Field {
            index,
            numbers: [1; 3],
            flows: [Vector2::splat(0.0); 2],
            marks: [false; 2],
            ground: Ground::Rock,
            divisor: if site.cell() == CELL { divisor } else { 1 },
            pair: Vector2::new(6, i32::MIN),
            byte: 1,
            total: 0.0,
        })
    };
    stops(fill(-1, 1).process(divided_with_overflow), CELL, None, "attempt to divide with overflow")?;
    let overflow = "attempt to calculate the remainder with overflow";
    stops(fill(-1, 1).process(remainder_with_overflow), CELL, None, overflow)?;
    // The second lane.
    stops(fill(-1, 1).process(vectors_divided), CELL, None, "attempt to divide with overflow")?;
    stops(fill(1, 0).process(unsigned_remainder), [0; 3], None, no_remainder)
}
