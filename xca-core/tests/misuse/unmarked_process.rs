//! A function that is not marked, a helper, and a number.
use xca_core::prelude::*;

#[derive(Substates, Clone)]
struct Life {
    alive: u8,
}

fn evolve(cell: &mut Cell<Life>) {
    cell.alive = 1;
}

#[helper]
fn twice(value: Real) -> Real {
    value + value
}

fn main() {
    let builder = Model::builder("life").substates::<Life>();
    let _ = builder.process(evolve).process(twice).process(3);
}
