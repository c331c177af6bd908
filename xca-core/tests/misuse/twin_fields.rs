// Two fields whose names differ in capitals only.
use xca_core::prelude::*;


#[derive(Substates, Clone)]
struct First {
    m: Real,
    M: Real,
}

fn main() {}
