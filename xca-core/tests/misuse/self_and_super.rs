// What only methods have.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    cell.temperature = Self::LIMIT;
    cell.temperature = self.limit;
}

fn main() {}
