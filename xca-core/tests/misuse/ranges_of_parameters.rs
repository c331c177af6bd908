// Ranges that hold nothing, that do not fit the type, and two at once.
use xca_core::prelude::*;

#[derive(Parameters, Clone, Debug)]
struct Empty {
    #[parameter(range = 1.0..=0.0)]
    share: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Both {
    #[parameter(positive, range = 0.0..)]
    share: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Twice {
    #[parameter(range = 0.0.., range = 1.0..)]
    share: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Said {
    #[parameter(positive = 3)]
    share: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Unit {
    #[parameter(unit = m)]
    depth: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Half {
    #[parameter(positive, range = ..=1.0)]
    #[parameter(computed, computed)]
    share: Real,
}

fn main() {}
