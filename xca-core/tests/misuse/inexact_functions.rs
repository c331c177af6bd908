// Functions whose last bits differ between machines.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = cell.temperature.exp();
    cell.temperature = cell.temperature.sin().powi(2);
    cell.temperature = cell.temperature.powf(1.5);
}

fn main() {}
