// Truth values as numbers, and numbers as truth values.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Forest {
    burning: bool,
    age: u8,
}

#[elementary_process]
fn counted(cell: &mut Cell<Forest>) {
    let mut count = 0;
    for n in 1..cell.neighbour_count() {
        count += cell.neighbour(n).burning;
    }
    cell.age = count;
}

#[elementary_process]
fn number_as_condition(cell: &mut Cell<Forest>) {
    if cell.age {
        cell.burning = true;
    }
}

#[elementary_process]
fn number_as_truth(cell: &mut Cell<Forest>) {
    cell.burning = 1;
}

#[elementary_process]
fn number_cast(cell: &mut Cell<Forest>) {
    cell.burning = cell.age as bool;
}

fn main() {}
