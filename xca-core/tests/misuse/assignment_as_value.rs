// An assignment is used as a value.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let mut count = 0;
    cell.kind = count += 1;
}

fn main() {}
