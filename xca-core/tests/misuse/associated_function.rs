// Functions of types are called.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = f64::max(cell.temperature, 0.0);
    cell.temperature += f64::from(cell.kind);
    cell.temperature = Heat::latent(cell.temperature);
}

fn main() {}
