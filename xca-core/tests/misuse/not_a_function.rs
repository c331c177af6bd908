// The attribute does not stand on a function.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
struct First {
    kind: u8,
}

struct Second;

impl Second {
    #[elementary_process]
    fn method(&self, cell: &mut Cell<Heat>) {
        cell.kind = 1;
    }
}

fn main() {}
