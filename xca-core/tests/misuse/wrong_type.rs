// A substate is given a value of another type.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.kind = cell.temperature;
    cell.temperature = 1;
}

fn main() {}
