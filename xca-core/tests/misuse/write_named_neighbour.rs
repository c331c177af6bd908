// A neighbour with a name is written.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let east = cell.neighbour(1);
    east.temperature += 1.0;
}

fn main() {}
