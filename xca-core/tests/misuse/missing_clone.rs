// The traits that substates and parameters need are not derived.
use xca_core::prelude::*;


#[derive(Substates)]
struct Plain {
    kind: u8,
}

#[derive(Parameters)]
struct Rule {
    number: u32,
}

fn main() {}
