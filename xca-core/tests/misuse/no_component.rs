// Components of what has none.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = cell.temperature.x;
    cell.temperature.y = 1.0;
}

fn main() {}
