use xca_core::prelude::*;

#[derive(States, Clone, Copy, PartialEq)]
enum Ground {
    Rock,
    Water,
}

#[derive(Substates, Clone, Copy)]
struct Land {
    ground: Ground,
    flows: [Real; 3],
}

#[elementary_process]
fn flood(cell: &mut Cell<Land>) {
    cell.ground = 1;
}

#[elementary_process]
fn flow(cell: &mut Cell<Land>) {
    cell.flows = 0.0;
    cell.flows.x = 1.0;
}

#[elementary_process]
fn unknown(cell: &mut Cell<Land>) {
    if cell.ground == Ground::Lava {
        cell.flows[0] = 1.0;
    }
}

#[elementary_process]
fn open(cell: &mut Cell<Land>) {
    match cell.ground {
        Ground::Rock => cell.flows[0] = 1.0,
    }
}

fn main() {
    let model = Model::builder("land").extents([1, 1, 1]).substates::<Land>().build().unwrap();
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default()).unwrap();
    simulation.state().sum(Land::GROUND).unwrap();
}
