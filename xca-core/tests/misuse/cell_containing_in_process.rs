// A process asks which cell contains a position.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn process(me: &mut Slot<Grain>, space: &Space) {
    let target = space.cell_containing(me.position);
    if target == Destination::Stay {
        me.kind = 1;
    }
}

fn main() {}
