// Faces and their outside values.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
}

struct Plain {
    temperature: f64,
}

fn main() {
    let _ = Model::builder("a").face(Boundary::Flat, Face::North);
    let _ = Model::builder("b").outside(Face::North, Plain { temperature: 1.0 });
    let _ = Model::builder("c").outside(Heat { temperature: 1.0 });
    let _ = Model::builder("d").boundaries([Boundary::Flat, Boundary::Toroidal]);
    let _ = Model::builder("e").boundaries(Faces { north: Boundary::Flat });
}
