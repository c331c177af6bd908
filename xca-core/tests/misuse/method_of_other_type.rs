// A method of vectors on a number, and of numbers on a vector.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn me_vector(kind: u8) -> Vector2<u8> {
    Vector2::splat(kind).abs()
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = cell.temperature.length();
    me_vector(cell.kind);
    cell.kind = cell.kind.sqrt();
}

fn main() {}
