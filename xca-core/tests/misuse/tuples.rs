// Tuples that are not taken apart, or of another number of parts.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[helper]
fn halves(value: Real) -> (Real, Real) {
    (0.5 * value, 0.5 * value)
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    let pair = (cell.kind, 1);
    cell.kind = pair.0;
    let ((a, b), c) = ((1, 2), 3);
    let mut rest = (1.0, 2.0);
    rest.0 = 3.0;
    let single = (1.0,);
    let nothing = ();
}

mod other {
    use super::*;

    #[elementary_process]
    fn process(cell: &mut Cell<Heat>) {
        let (a, b, c) = halves(cell.temperature);
        cell.temperature = halves(cell.temperature);
    }
}

fn main() {}
