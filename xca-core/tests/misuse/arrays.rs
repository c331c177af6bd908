use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Nested {
    flows: [[Real; 3]; 2],
}

#[derive(Substates, Clone, Copy)]
struct Empty {
    flows: [Real; 0],
}

#[derive(Substates, Clone, Copy)]
struct Long {
    flows: [Real; 5000],
}

fn main() {}
