// A `for` over what is no array, and a step that is no index.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn over_a_number(cell: &mut Cell<Heat>) {
    for value in cell.kind {
        cell.temperature += 1.0;
    }
}

#[elementary_process]
fn by_a_byte(cell: &mut Cell<Heat>) {
    for i in (0..10).step_by(cell.kind) {
        cell.kind += i;
    }
}

fn main() {}
