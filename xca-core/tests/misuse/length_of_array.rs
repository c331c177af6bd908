// Lengths of arrays that are not known when the process is compiled, or are no `usize`.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

const SIDES: u32 = 6;

#[elementary_process]
fn by_a_variable(cell: &mut Cell<Heat>) {
    let n = 4;
    let values = [0.0; n];
    cell.temperature = values[0];
}

#[elementary_process]
fn by_a_small_constant(cell: &mut Cell<Heat>) {
    let values = [0.0; SIDES];
    cell.temperature = values[0];
}

fn main() {}
