// Iterators.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let mut weights = [0.25, 0.5, 0.25];
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
    for weight in weights.iter_mut() {
        *weight *= 2.0;
    }
    for weight in &mut weights {
        *weight *= 2.0;
    }
    for weight in weights.iter() {
        *weight *= 2.0;
    }
    for weight in weights.iter().enumerate() {
        cell.temperature += weight;
    }
    for (i, weight) in weights {
        cell.temperature += weight;
    }
    for (weight, other) in weights.iter().zip(weights) {
        cell.temperature += weight * other;
    }
    cell.temperature = weights.iter().sum();
    cell.temperature += weights.iter().map(abs).sum::<Real>();
    if weights.iter().any(|weight| return *weight > 0.0) {
        cell.kind = 1;
    }
    let all = weights.iter().map(|weight| 2.0 * weight).collect();
}

fn main() {}
