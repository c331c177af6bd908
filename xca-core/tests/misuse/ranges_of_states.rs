// Ranges of parameters that are no numbers.
use xca_core::prelude::*;

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Ground {
    Rock,
    Soil,
}

#[derive(Parameters, Clone, Debug)]
struct OfStates {
    #[parameter(unit = "m", range = 0.0..=1.0)]
    ground: Ground,
}

#[derive(Parameters, Clone, Debug)]
struct PositiveState {
    #[parameter(positive)]
    ground: Ground,
}

#[derive(Parameters, Clone, Debug)]
struct OfBool {
    #[parameter(range = 0.0..)]
    wet: bool,
}

type Wet = bool;

#[derive(Parameters, Clone, Debug)]
struct OfArrays {
    #[parameter(range = 0.0..)]
    wet: [Wet; 3],
    #[parameter(positive, range = ..1.0)]
    grounds: [Ground; 2],
}

// These have one.
#[derive(Parameters, Clone, Debug)]
struct OfNumbers {
    #[parameter(range = 0.0..)]
    heights: [Vector2<Real>; 2],
    #[parameter(positive)]
    count: u8,
}

#[elementary_process]
fn flow(cell: &mut Cell<Land>, states: &OfStates) {
    if states.ground == Ground::Rock {
        cell.depth = 0.0;
    }
}

#[derive(Substates, Clone, Copy)]
struct Land {
    depth: Real,
}

fn main() {}
