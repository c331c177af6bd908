// An element is taken with a number that is no usize, a neighbour with one that is no u32.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let weights = [0.25, 0.5, 0.25];
    cell.temperature = weights[cell.kind];
    cell.temperature += cell.neighbour(cell.kind).temperature;
}

fn main() {}
