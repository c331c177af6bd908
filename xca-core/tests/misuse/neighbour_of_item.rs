// An item asks for a neighbouring cell.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn process(me: &mut Slot<Grain>) {
    let east = me.neighbour(1);
    me.kind = me.neighbour(2).kind;
    for n in 1..me.neighbours() {
        me.kind += 1;
    }
}

fn main() {}
