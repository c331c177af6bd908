// The struct of the substates does not exist.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Haet>) {
    cell.temperature = 1.0;
}

fn main() {}
