// Methods that Rust has and a process has not, and methods of `Real` on other floats.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    single: f32,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = cell.temperature.mul_add(2.0, 1.0);
    cell.temperature = cell.temperature.asinh();
    cell.temperature = cell.temperature.log(10.0);
    cell.temperature = cell.temperature.sin_cos().0;
    cell.temperature = cell.temperature.round_ties_even();
    cell.temperature = cell.temperature.max();
    cell.temperature = cell.temperature.powf(1.0, 2.0);
    cell.temperature = cell.temperature.clmp(1.0, 2.0);
    cell.temperature = f64::exp(cell.temperature);
    cell.temperature = Real::powf(cell.temperature, 1.5);
    cell.temperature = f64::mul_add(cell.temperature, 2.0, 1.0);
}

mod of_other_types {
    use super::Heat;
    use xca_core::prelude::*;

    #[elementary_process]
    fn process(cell: &mut Cell<Heat>) {
        cell.single = cell.single.exp();
        cell.kind = cell.kind.abs();
        cell.kind = cell.kind.sqrt();
        cell.temperature = cell.temperature.wrapping_add(1.0);
        cell.temperature = cell.temperature.length();
        cell.kind = cell.kind.len();
    }
}

fn main() {}
