// A process returns a value.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn first(cell: &mut Cell<Heat>) -> Real {
    2.0 * cell.temperature
}

#[elementary_process]
fn second(cell: &mut Cell<Heat>) {
    2.0 * cell.temperature
}

#[elementary_process]
fn third(cell: &mut Cell<Heat>) {
    return 2.0 * cell.temperature;
}

fn main() {}
