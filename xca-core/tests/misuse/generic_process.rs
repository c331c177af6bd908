// A process and a helper are generic.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn first<S: Substates>(cell: &mut Cell<S>) {
    let _n = cell.neighbour_count();
}

#[helper]
fn second<T>(value: T) -> T {
    value
}

fn main() {}
