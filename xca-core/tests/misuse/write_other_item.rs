// Another item is written.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn process(me: &mut Slot<Grain>) {
    for other in me.others_in_cell() {
        other.kind = 2;
    }
}

fn main() {}
