// A parameter is a u8.
use xca_core::prelude::*;


#[derive(Parameters, Clone, Debug)]
struct Rule {
    number: u8,
}

fn main() {}
