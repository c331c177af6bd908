// A pattern binds a reference.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    match cell.kind {
        0 => {}
        ref other => cell.kind = other - 1,
    }
}

fn main() {}
