// A helper has an error; the processes that call it have none of their own.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn decayed(value: Real) -> Real {
    value.exp()
}

#[helper]
fn rounded(value: Real) -> Real {
    let number: i32 = value;
    number as Real
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = decayed(cell.temperature) + rounded(cell.temperature);
}

fn main() {}
