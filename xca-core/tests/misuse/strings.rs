// Strings and characters.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let name = "hot";
    let letter = 'h';
    cell.kind = 1;
}

fn main() {}
