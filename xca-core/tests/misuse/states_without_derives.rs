// States that are neither copied nor compared. The last two messages are of the struct's own derives.
use xca_core::prelude::*;

#[derive(States)]
enum Ground {
    Rock,
    Water,
}

#[derive(Substates, Clone, Copy)]
struct Land {
    ground: Ground,
    depth: Real,
}

#[elementary_process]
fn flood(cell: &mut Cell<Land>) {
    match cell.ground {
        Ground::Rock => cell.depth = 0.0,
        Ground::Water => cell.depth = 1.0,
    }
}

fn main() {}
