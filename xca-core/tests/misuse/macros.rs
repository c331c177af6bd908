// Macros.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    println!("{}", cell.temperature);
    assert!(cell.temperature > 0.0);
    let weights = vec![1.0, 2.0];
}

fn main() {}
