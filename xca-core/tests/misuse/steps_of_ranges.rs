// Ranges in steps that are none.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn nought(cell: &mut Cell<Heat>) {
    for i in (0..10).step_by(0) {
        cell.temperature += i as Real;
    }
}

#[elementary_process]
fn missing(cell: &mut Cell<Heat>) {
    for i in (0..10).rev().step_by() {
        cell.temperature += i as Real;
    }
}

#[elementary_process]
fn float(cell: &mut Cell<Heat>) {
    for i in (0..10).step_by(0.5) {
        cell.temperature += i as Real;
    }
}

#[elementary_process]
fn backwards(cell: &mut Cell<Heat>) {
    for i in (0..10).rev(2) {
        cell.temperature += i as Real;
    }
}

fn main() {}
