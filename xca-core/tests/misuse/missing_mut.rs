// The cell is taken without `mut`.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &Cell<Heat>) {
    cell.temperature = 0.0;
}

fn main() {}
