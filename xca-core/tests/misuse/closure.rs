// A closure.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let double = |x: Real| 2.0 * x;
    cell.temperature = double(cell.temperature);
}

fn main() {}
