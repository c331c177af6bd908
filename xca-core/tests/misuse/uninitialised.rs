// A variable starts without a value.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let flux;
    if cell.kind == 0 {
        flux = 1.0;
    } else {
        flux = 2.0;
    }
    cell.temperature = flux;
}

fn main() {}
