// A neighbour and the cell are used as values.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let east = cell.neighbour(1);
    let same = east;
    let own = cell;
    cell.temperature = cell.neighbour(2);
}

fn main() {}
