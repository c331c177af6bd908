// A parameter is a plain number.
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
fn first(cell: &mut Cell<Heat>, alpha: Real) {
    cell.temperature *= alpha;
}

#[elementary_process]
fn second(cell: &mut Cell<Heat>, alpha: &Real) {
    cell.temperature *= alpha;
}

#[elementary_process]
fn third(cell: &mut Cell<Heat>, p: Conduction) {
    cell.temperature *= p.alpha;
}

fn main() {}
