// The items of a cell are counted and indexed.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>, grains: &Slots<Grain>) {
    cell.kind = grains.len() as u8;
    cell.kind = grains[0].kind;
    cell.kind = grains.kind;
}

fn main() {}
