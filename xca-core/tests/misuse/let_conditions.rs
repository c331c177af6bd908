// `if let`, `while let` and `let … else`.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    if let 1 = cell.kind {
        cell.kind = 2;
    }
    while let 2 = cell.kind {
        cell.kind = 3;
    }
    let 3 = cell.kind else { return };
}

fn main() {}
