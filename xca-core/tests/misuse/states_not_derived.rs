use xca_core::prelude::*;

#[derive(Clone, Copy, PartialEq)]
enum Ground {
    Rock,
    Water,
}

#[derive(Substates, Clone, Copy)]
struct Land {
    ground: Ground,
}

fn main() {}
