// Arrays that are too large, alone and together.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

const SIDES: usize = 5_000;

#[elementary_process]
fn alone(cell: &mut Cell<Heat>) {
    let mut values = [0.0; 400_000];
    values[0] = cell.temperature;
    cell.temperature = values[3];
}

#[elementary_process]
fn together(cell: &mut Cell<Heat>) {
    let first = [cell.temperature; SIDES];
    let second = [Vector3::splat(1.0); SIDES];
    cell.temperature = first[0] + second[0].x;
}

fn main() {}
