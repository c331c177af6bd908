// A variable and a cast have types that no engine shares.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let big: i64 = 3;
    cell.kind = cell.temperature as u64 as u8;
}

fn main() {}
