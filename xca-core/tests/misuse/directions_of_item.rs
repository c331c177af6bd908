// An item asks where the neighbours of a cell lie.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn process(me: &mut Slot<Grain>) {
    me.kind = me.neighbour_count() as u8;
    me.kind = me.opposite(1) as u8;
    me.kind = me.displacement(1).x as u8;
    if me.exists(1) {
        me.kind = 0;
    }
}

fn main() {}
