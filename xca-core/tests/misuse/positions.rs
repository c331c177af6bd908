// Positions of the wrong type, twice, and among parameters.
use xca_core::prelude::*;


#[derive(Substates, Clone)]
struct First {
    #[position]
    position: Vector2<Real>,
}

#[derive(Substates, Clone)]
struct Second {
    #[position]
    centre: Vector3<Real>,
    #[position]
    corner: Vector3<Real>,
}

fn main() {}
