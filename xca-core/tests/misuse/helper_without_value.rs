// A helper ends without its value.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn decayed(value: Real) -> Real {
    0.5 * value;
}

fn main() {}
