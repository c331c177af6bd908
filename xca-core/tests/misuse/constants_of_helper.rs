// A helper that is generic in a constant, called without it and with a wrong one.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn sum<const N: usize>(values: [Real; N]) -> Real {
    let mut sum = 0.0;
    for value in values {
        sum += value;
    }
    sum
}

#[elementary_process]
fn without(cell: &mut Cell<Heat>) {
    cell.temperature = sum([1.0, 2.0, 3.0]);
}

#[elementary_process]
fn open(cell: &mut Cell<Heat>) {
    cell.temperature = sum::<_>([1.0, 2.0, 3.0]);
}

#[elementary_process]
fn of_another_length(cell: &mut Cell<Heat>) {
    cell.temperature = sum::<4>([1.0, 2.0, 3.0]);
}

fn main() {}
