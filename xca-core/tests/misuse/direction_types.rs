// A direction is taken of what is no number of a neighbour, and for what it is not.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let back = cell.opposite(cell.kind);
    let step = cell.displacement(1.0);
    if cell.exists(cell.displacement(2)) {
        cell.kind = cell.opposite(3);
    }
    cell.temperature = cell.displacement(1).x;
}

fn main() {}
