// A field of a constant.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

const COLD: Heat = Heat { temperature: 0.0, kind: 0 };

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = COLD.temperature;
}

fn main() {}
