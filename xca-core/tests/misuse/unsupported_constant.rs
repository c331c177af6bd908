// A constant has a type that a process cannot use.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

const LIMIT: i64 = 12;

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.kind = (LIMIT % 7) as u8;
}

fn main() {}
