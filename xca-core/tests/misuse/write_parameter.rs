// A parameter is written.
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
    p.alpha *= 0.5;
}

fn main() {}
