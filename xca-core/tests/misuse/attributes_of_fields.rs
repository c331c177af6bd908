// What is said of a field in a way that is not known.
use xca_core::prelude::*;

#[derive(Parameters, Clone, Debug)]
struct First {
    #[parameter(limit = 3.0)]
    speed: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Second {
    #[parameter(range = 3.0)]
    speed: Real,
}

#[derive(Substates, Clone)]
struct Third {
    #[substate(range = 0.0..)]
    depth: Real,
}

#[derive(Substates, Clone)]
struct Fourth {
    #[parameter(unit = "m")]
    depth: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Fifth {
    #[parameter(range = LEAST..)]
    speed: Real,
}

fn main() {}
