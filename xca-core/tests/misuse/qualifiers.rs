// Async, unsafe and const processes.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
async fn first(cell: &mut Cell<Heat>) {
    cell.kind = 1;
}

#[elementary_process]
unsafe fn second(cell: &mut Cell<Heat>) {
    cell.kind = 1;
}

#[elementary_process]
const fn third(cell: &mut Cell<Heat>) {
    cell.kind = 1;
}

fn main() {}
