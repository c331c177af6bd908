// A variable is written that was not made.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let mut flux = 0.0;
    flx += cell.temperature;
    total = 1.0;
    cell.temperature = flux;
}

fn main() {}
