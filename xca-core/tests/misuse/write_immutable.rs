// A variable without `mut` is written.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let flux = 0.0;
    for n in 1..cell.neighbour_count() {
        flux += cell.neighbour(n).temperature;
    }
    cell.temperature = flux;
}

fn main() {}
