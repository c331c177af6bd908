// A match does not name all values.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    match cell.kind {
        0 => cell.kind = 1,
        1..=9 => cell.kind = 2,
    }
}

fn main() {}
