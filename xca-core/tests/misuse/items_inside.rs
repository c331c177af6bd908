// Items within a process.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    const LIMIT: Real = 3.0;
    fn double(x: Real) -> Real {
        2.0 * x
    }
    cell.temperature = double(LIMIT);
}

fn main() {}
