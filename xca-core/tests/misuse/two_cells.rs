// A process takes two cells, or other companions that do not fit.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[derive(Parameters, Clone, Debug)]
struct Conduction {
    alpha: Real,
}

#[derive(Substates, Clone, Copy)]
struct Grain {
    kind: u8,
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn first(cell: &mut Cell<Heat>, other: &Cell<Heat>) {
    cell.kind = other.kind;
}

#[elementary_process]
fn second(me: &mut Slot<Grain>, all: &Slots<Grain>) {
    me.kind = 1;
}

#[elementary_process]
fn third(cell: &mut Cell<Heat>, p: &Conduction, q: &Conduction) {
    cell.temperature = p.alpha * q.alpha;
}

fn main() {}
