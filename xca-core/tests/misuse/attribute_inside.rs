// An attribute that would be lost.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    #[cfg(debug_assertions)]
    let limit = 3.0;
    cell.temperature = limit;
}

fn main() {}
