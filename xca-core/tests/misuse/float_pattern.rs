// A float is compared by a pattern.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    match cell.temperature {
        0.0 => cell.kind = 1,
        _ => cell.kind = 2,
    }
}

fn main() {}
