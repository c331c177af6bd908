// A neighbour is taken with a number that is no usize.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature += cell.neighbour(cell.kind).temperature;
}

fn main() {}
