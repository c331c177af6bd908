// A function is called that is not marked.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

use std::cmp::max;

fn decayed(value: Real) -> Real {
    0.5 * value
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = decayed(cell.temperature);
    cell.kind = max(cell.kind, 3);
}

fn main() {}
