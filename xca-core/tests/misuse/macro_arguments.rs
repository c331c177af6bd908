// The attribute has arguments.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process(slots)]
fn first(cell: &mut Cell<Heat>) {
    cell.kind = 1;
}

#[helper(inline)]
fn second(value: Real) -> Real {
    value
}

fn main() {}
