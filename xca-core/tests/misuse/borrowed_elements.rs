// Elements are references, as everywhere in Rust.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    hot: bool,
}

#[helper]
fn double(value: Real) -> Real {
    2.0 * value
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let weights = [0.25, 0.5, 0.25];
    for weight in weights.iter() {
        if weight > 0.3 {
            cell.temperature += double(weight);
        }
    }
    cell.hot = weights.iter().filter(|weight| *weight > 0.0).any(|weight| weight);
}

fn main() {}
