// A process over cells writes the items.
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
    for grain in grains {
        grain.kind = cell.kind;
    }
}

fn main() {}
