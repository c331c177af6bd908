// The neighbours are counted by a word that there is not.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    for n in 1..cell.neighbours() {
        cell.temperature += cell.neighbour(n).temperature;
    }
}

fn main() {}
