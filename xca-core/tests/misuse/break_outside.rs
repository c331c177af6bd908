// `break` and `continue` stand outside a loop.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    if cell.kind == 0 {
        break;
    }
    continue;
}

fn main() {}
