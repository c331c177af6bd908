// A struct is made.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    *cell = Heat { temperature: 0.0, kind: 1 };
    let cold = Heat { temperature: 0.0, kind: 1 };
}

fn main() {}
