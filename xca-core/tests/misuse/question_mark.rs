// `?`.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let root = cell.temperature.sqrt()?;
    cell.temperature = root;
}

fn main() {}
