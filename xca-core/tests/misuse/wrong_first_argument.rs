// The first argument is no cell and no item.
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
fn first(p: &Conduction, cell: &mut Cell<Heat>) {
    cell.temperature *= p.alpha;
}

#[elementary_process]
fn second(heat: &mut Heat) {
    heat.temperature = 0.0;
}

#[elementary_process]
fn third() {}

#[migration]
fn fourth(cell: &Cell<Heat>) -> Destination {
    Destination::Stay
}

fn main() {}
