// A helper takes values by reference.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn decayed(value: &Real) -> Real {
    0.5 * value
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = decayed(&cell.temperature);
}

fn main() {}
