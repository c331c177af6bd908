// A fault is used as a value, and reported without one.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = cell.fault(1, 2.0);
    cell.fault(1);
}

fn main() {}
