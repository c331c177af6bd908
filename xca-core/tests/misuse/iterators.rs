// Iterators.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let weights = [0.25, 0.5, 0.25];
    for weight in weights.iter() {
        cell.temperature *= weight;
    }
    for weight in &weights {
        cell.temperature *= weight;
    }
    for weight in weights.rev() {
        cell.temperature *= weight;
    }
    for i in (0..3).step_by(2).rev() {
        cell.temperature *= weights[i];
    }
    for i in 3 {
        cell.temperature *= weights[i];
    }
    for east in cell.neighbours() {
        cell.temperature += east.temperature;
    }
}

fn main() {}
