// Arguments are `mut`.
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
fn first(mut cell: &mut Cell<Heat>) {
    cell.temperature = 0.0;
}

#[elementary_process]
fn second(cell: &mut Cell<Heat>, p: &mut Conduction) {
    p.alpha = cell.temperature;
}

#[helper]
fn third(mut value: Real) -> Real {
    value *= 2.0;
    value
}

#[migration]
fn fourth(me: &mut Slot<Heat>) -> Destination {
    Destination::Stay
}

fn main() {}
