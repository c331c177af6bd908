// A range in a pattern leaves its last value out.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    match cell.kind {
        0..3 => cell.kind = 1,
        _ => {}
    }
}

fn main() {}
