use xca_core::prelude::*;

#[derive(States, Clone, Copy, PartialEq)]
enum WithFields {
    Calm,
    Burning(u8),
}

#[derive(States, Clone, Copy, PartialEq)]
enum WithNumbers {
    Calm = 3,
    Burning,
}

#[derive(States, Clone, Copy, PartialEq)]
enum Nothing {}

#[derive(States, Clone, Copy, PartialEq)]
struct NoEnum {
    calm: bool,
}

fn main() {}
