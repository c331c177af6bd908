//! What Rust stops a process for: an index beyond an array, a division without a result, a range in
//! steps of 0. Every engine
//! stops there with the same fault, in the same words, whether its machine can panic or not.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::{Fault, ModelBuilder};
use xca_tests::suite::engines::{self, assert_same_fault, assert_same_runs};

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Ground {
    Rock,
    Soil,
    Water,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Field {
    /// In which cell something goes wrong.
    index: u32,
    numbers: [i32; 3],
    flows: [Vector2<Real>; 2],
    marks: [bool; 2],
    ground: Ground,
    divisor: i32,
    pair: Vector2<i32>,
    byte: u8,
    total: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    index: u32,
    shares: [Real; 3],
    sum: Real,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Plan {
    weights: [Real; 3],
    wanted: [bool; 2],
    least: i32,
}

const TABLE: [i32; 4] = [3, 1, 4, 1];

#[helper]
fn picked(numbers: [i32; 3], index: u32) -> i32 {
    numbers[index as usize]
}

#[helper]
fn share(p: &Plan, index: u32) -> Real {
    p.weights[index as usize]
}

#[helper]
fn halves(value: i32, divisor: i32) -> i32 {
    value / divisor
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

#[elementary_process]
fn own_of_an_item(me: &mut Slot<Grain>) {
    me.sum = me.shares[me.index as usize];
}

#[elementary_process]
fn written_of_an_item(me: &mut Slot<Grain>) {
    me.shares[me.index as usize] += 1.0;
}

#[elementary_process]
fn of_another_item(me: &mut Slot<Grain>) {
    for other in me.others() {
        me.sum += other.shares[other.index as usize];
    }
}

#[elementary_process]
fn of_the_cell(me: &mut Slot<Grain>, cell: &Cell<Field>) {
    me.sum += cell.numbers[me.index as usize] as Real;
}

#[elementary_process]
fn of_an_item_in_the_cell(cell: &mut Cell<Field>, grains: &Slots<Grain>) {
    for grain in grains {
        cell.total += grain.shares[grain.index as usize];
    }
}

#[migration]
fn moved_by_a_table(me: &Slot<Grain>) -> Destination {
    if TABLE[me.index as usize] == 9 { Destination::Outside } else { Destination::Stay }
}

/// Of 24 cells those from the place on are faulty: each asks for elements, and divides by numbers, of its
/// own.
fn base(from: usize) -> ModelBuilder {
    let place = |[x, y, z]: [usize; 3]| x + 4 * y + 12 * z;
    Model::builder("faulty")
        .extents([4, 3, 2])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .boundaries([Boundary::Toroidal, Boundary::Flat, Boundary::Flat])
        .parameters(Plan { weights: [0.5, 0.25, 0.125], wanted: [false, true], least: i32::MIN })
        .substates::<Field>()
        .population::<Grain>(3)
        .fill(move |site| {
            let place = place(site.cell());
            let faulty = place >= from;
            Field {
                index: if faulty { 3 + (place - from) as u32 } else { 1 },
                numbers: [1, 2, 3],
                flows: [Vector2::new(0.5, 1.5), Vector2::new(2.5, place as f64)],
                marks: [true, false],
                ground: Ground::Soil,
                divisor: i32::from(!faulty),
                pair: Vector2::new(6, i32::MIN),
                byte: u8::from(!faulty),
                total: 0.0,
            }
        })
        .initialise(move |state| {
            let grain = |label: u32, cell: [usize; 3], index: u32| {
                let state = Grain { index, shares: [1.0, 2.0, 3.0], sum: 0.0 };
                Item { label, cell, state }
            };
            Ok(state.set_items(vec![
                grain(9, [0, 0, 0], 2),
                grain(7, [3, 1, 1], 8),
                grain(4, [3, 1, 1], 9),
                grain(2, [3, 2, 1], 5),
            ])?)
        })
}

/// Each engine stops in the first step, at this cell and item, with this message.
fn stops(
    builder: ModelBuilder,
    cell: [usize; 3],
    label: Option<u32>,
    message: &str,
) -> Result<(), Box<dyn Error>> {
    let model = builder.build()?;
    let process = model.processes()[0].name;
    let engines = engines::all()?;
    for precision in engines::PRECISIONS {
        let error = assert_same_fault(&model, &engines, RunOptions { precision, seed: 0 }, 2);
        let RunError::Fault { step: 1, fault, .. } = error else { panic!("{process}: {error}") };
        let wanted = Fault::Panicked { process, cell, label, message: message.to_owned() };
        assert_eq!(fault, wanted);
    }
    Ok(())
}

/// The tenth cell is the first one with a fault.
const FIRST: usize = 9;
const CELL: [usize; 3] = [1, 2, 0];

fn beyond(length: u32, index: u32) -> String {
    format!("index out of bounds: the len is {length} but the index is {index}")
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

#[test]
fn a_range_in_steps_of_0() -> Result<(), Box<dyn Error>> {
    let no_step = "assertion failed: step != 0";
    stops(base(FIRST).process(in_steps), CELL, None, no_step)?;
    stops(base(FIRST).process(in_steps_through_nothing), CELL, None, no_step)?;
    stops(base(FIRST).process(in_steps_of_a_helper), CELL, None, no_step)?;
    stops(base(FIRST).process(in_steps_of_a_constant), CELL, None, no_step)
}

#[test]
fn an_item() -> Result<(), Box<dyn Error>> {
    let cell = [3, 1, 1];
    stops(base(24).process(own_of_an_item), cell, Some(4), &beyond(3, 9))?;
    stops(base(24).process(written_of_an_item), cell, Some(4), &beyond(3, 9))?;
    // The item with the label 4 sees that with the label 7.
    stops(base(24).process(of_another_item), cell, Some(4), &beyond(3, 8))?;
    stops(base(24).process(of_the_cell), cell, Some(4), &beyond(3, 9))?;
    stops(base(24).process(of_an_item_in_the_cell), cell, None, &beyond(3, 9))?;
    stops(base(24).process(moved_by_a_table), cell, Some(4), &beyond(4, 9))
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
