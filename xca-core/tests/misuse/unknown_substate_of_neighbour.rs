// A substate of a neighbour is read that does not exist.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = cell.neighbour(1).pressure;
    let east = cell.neighbour(1);
    cell.temperature += east.pressure;
}

fn main() {}
