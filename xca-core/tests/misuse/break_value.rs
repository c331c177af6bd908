// A loop has a value.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let n = loop {
        break 3;
    };
    cell.kind = n;
}

fn main() {}
