// Tuples.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let (low, high) = (0.0, 1.0);
    let pair = (cell.kind, 1);
    cell.kind = pair.0;
}

fn main() {}
