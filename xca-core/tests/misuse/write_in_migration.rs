// A migration writes a substate.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[migration]
fn process(me: &Slot<Grain>, space: &Space) -> Destination {
    me.kind = 0;
    space.cell_containing(me.position)
}

fn main() {}
