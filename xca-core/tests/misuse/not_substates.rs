// The structs derive nothing.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

struct Plain {
    kind: u8,
}

#[elementary_process]
fn first(cell: &mut Cell<Plain>) {
    cell.kind = 1;
}

#[elementary_process]
fn second(cell: &mut Cell<Heat>, p: &Plain) {
    cell.kind = p.kind;
}

fn main() {}
