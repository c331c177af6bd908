// A variable is read that was not made.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let flux = cell.temperature;
    cell.temperature = flx + pressure;
}

fn main() {}
