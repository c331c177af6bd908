// A search is used as a value, and without its radius.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn process(me: &mut Slot<Grain>) {
    let near = me.others_within(0.5);
    for other in me.others_within() {
        me.kind += other.kind;
    }
    for other in me.others(0.5) {
        me.kind += other.kind;
    }
}

fn main() {}
