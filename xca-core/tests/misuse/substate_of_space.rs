// A field of the space.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>, space: &Space) {
    cell.temperature = space.side;
    cell.temperature = space.volume();
}

fn main() {}
