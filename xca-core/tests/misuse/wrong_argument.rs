// A helper is given a value of another type, and one too few.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn mean(a: Real, b: Real) -> Real {
    0.5 * (a + b)
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = mean(cell.temperature, cell.kind);
    cell.temperature = mean(cell.temperature);
}

fn main() {}
