// A variable has another type than its value.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let count: u32 = 1.5;
    if count {
        cell.kind = 1;
    }
}

fn main() {}
