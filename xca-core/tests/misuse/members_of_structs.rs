// Several structs of a cell: a substate that another one has, one that is only read, and a struct of items in place of one of cells.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Ground {
    altitude: Real,
}

#[derive(Substates, Clone, Copy)]
struct Water {
    depth: Real,
}

#[elementary_process]
fn of_the_other(water: &mut Cell<Water>, ground: &Cell<Ground>) {
    water.depth = ground.depth - water.neighbour(1).altitude;
}

#[elementary_process]
fn read_only(water: &mut Cell<Water>, ground: &Cell<Ground>) {
    ground.altitude += water.depth;
}

#[elementary_process]
fn without_reference(water: &mut Cell<Water>, ground: Cell<Ground>) {
    water.depth = ground.altitude;
}

#[elementary_process]
fn faults_of_another(water: &mut Cell<Water>, ground: &Cell<Ground>) {
    ground.fault(1, water.depth);
}

fn main() {}
