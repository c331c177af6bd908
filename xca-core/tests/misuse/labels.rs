// Labels.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    'outer: for i in 0..3 {
        cell.kind += i;
    }
    'search: loop {
        loop {
            break 'search;
        }
    }
}

fn main() {}
