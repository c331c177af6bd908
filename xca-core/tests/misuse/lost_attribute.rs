// An attribute of functions on a process.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
#[inline]
fn process(cell: &mut Cell<Heat>) {
    cell.kind = 1;
}

fn main() {}
