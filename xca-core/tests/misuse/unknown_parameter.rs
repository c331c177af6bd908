// A parameter is read that does not exist.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[derive(Parameters, Clone, Debug)]
struct Conduction {
    alpha: Real,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>, p: &Conduction) {
    cell.temperature *= p.alhpa;
}

fn main() {}
