// A process over cells searches for items.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    for other in cell.others_in_cell() {
        cell.kind = other.kind;
    }
}

fn main() {}
