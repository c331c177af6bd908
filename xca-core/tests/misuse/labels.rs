// Labels that no loop has, that two loops have, and of blocks.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn process(cell: &mut Cell<Heat>) {
    'search: loop {
        loop {
            break 'serch;
        }
        continue 'other;
    }
    'outer: for _ in 0..3 {
        'outer: for _ in 0..3 {
            cell.kind += 1;
        }
    }
    'block: {
        break 'block;
    }
}

fn main() {}
