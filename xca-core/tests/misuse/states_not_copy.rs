use xca_core::prelude::*;

#[derive(States, PartialEq)]
enum Ground {
    Rock,
    Water,
}

fn main() {}
