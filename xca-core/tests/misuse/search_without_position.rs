// A search within a radius among items without a position.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Token {
    kind: u8,
}

#[elementary_process]
fn process(me: &mut Slot<Token>) {
    for other in me.others_within(0.5) {
        me.kind += other.kind;
    }
}

fn main() {}
