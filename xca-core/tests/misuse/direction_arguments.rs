// It is not said which neighbour is meant, or too much.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let count = cell.neighbour_count(1);
    let back = cell.opposite();
    let step = cell.displacement(1, 2);
    if cell.exists() {
        cell.temperature = 0.0;
    }
}

fn main() {}
