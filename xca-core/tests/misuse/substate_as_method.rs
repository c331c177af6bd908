// Substates are read and written by methods.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.set_temperature(cell.temperature() + cell.neighbour(1).temperature());
}

fn main() {}
