// Migrations answer with something else.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[migration]
fn first(me: &Slot<Grain>) {
    Destination::Stay
}

#[migration]
fn second(me: &Slot<Grain>) -> u32 {
    me.kind as u32
}

#[migration]
fn third(me: &Slot<Grain>, space: &Space) -> Destination {
    if me.kind == 0 { Destination::Cell(3) } else { space.containing(me.position) }
}

fn main() {}
