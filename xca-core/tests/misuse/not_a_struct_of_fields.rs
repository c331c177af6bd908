// Substates without names.
use xca_core::prelude::*;


#[derive(Substates, Clone)]
struct First(Real, u8);

#[derive(Substates, Clone)]
struct Second;

#[derive(Substates, Clone)]
enum Third {
    Hot,
    Cold,
}

#[derive(Parameters, Clone, Debug)]
struct Fourth<T> {
    value: T,
}

fn main() {}
