// A number has a type that no engine shares.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.kind = cell.kind + 1_u64 as u8;
}

fn main() {}
