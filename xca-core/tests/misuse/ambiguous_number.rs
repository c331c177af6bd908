// A method on a number whose type nothing says.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let two = 2.0;
    cell.temperature = two.sqrt();
}

fn main() {}
