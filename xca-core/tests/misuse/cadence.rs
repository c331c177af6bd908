// How often processes run, said in the wrong place or of no process.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
}

#[elementary_process]
fn cool(cell: &mut Cell<Heat>) {
    cell.temperature *= 0.5;
}

fn melt() {}

fn main() {
    let _ = Model::builder("a").process_every(cool, 10);
    let _ = Model::builder("b").process_every(10, melt);
    let _ = Model::builder("c").repeat(4, [cool, cool]);
    let _ = Model::builder("d").repeat(-1, cool);
    let _ = Model::builder("e").process(cool, cool);
}
