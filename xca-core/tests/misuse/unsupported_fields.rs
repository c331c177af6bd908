// Fields of types that cannot be stored.
use xca_core::prelude::*;


#[derive(Substates, Clone)]
struct First {
    big: i64,
}

#[derive(Substates, Clone)]
struct Second {
    alive: bool,
}

#[derive(Substates, Clone)]
struct Third {
    name: String,
}

#[derive(Substates, Clone)]
struct Fourth {
    weights: [Real; 3],
}

fn main() {}
