// A helper takes the cell.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn decayed(cell: &Cell<Heat>) -> Real {
    0.5 * cell.temperature
}

fn main() {}
