// A helper has no result.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn check(value: Real) {
    let _doubled = 2.0 * value;
}

fn main() {}
