// A method of numbers is mistyped.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = cell.temperature.sqroot();
    cell.kind = cell.kind.mim(3);
}

fn main() {}
