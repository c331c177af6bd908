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
    cell.temperature = cell.temperature.ln();
    cell.temperature = cell.temperature.tanh();
    cell.temperature = cell.temperature.atan2(1.0);
    cell.temperature = cell.temperature.log10();
    cell.temperature = cell.temperature.asin();
    cell.temperature = cell.temperature.cosh();
    cell.temperature = cell.temperature.mul_add(2.0, 1.0);
    cell.temperature = f64::exp(cell.temperature);
    cell.temperature = Real::powf(cell.temperature, 1.5);
    cell.temperature = f64::mul_add(cell.temperature, 2.0, 1.0);
}

#[helper]
fn wave(x: Real) -> Real {
    x.sin()
}

fn main() {}
