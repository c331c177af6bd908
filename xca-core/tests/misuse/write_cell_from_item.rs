// A process over items writes the cell.
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
fn process(me: &mut Slot<Grain>, cell: &Cell<Heat>) {
    cell.kind = me.kind;
}

fn main() {}
