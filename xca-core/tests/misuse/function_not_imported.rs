// A mathematical function without its import, and with a number of another type.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    single: f32,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = exp(cell.temperature);
}

mod other {
    use super::Heat;
    use xca_core::math::exp;
    use xca_core::prelude::*;

    #[elementary_process]
    fn process(cell: &mut Cell<Heat>) {
        cell.temperature = exp(cell.single);
    }
}

fn main() {}
