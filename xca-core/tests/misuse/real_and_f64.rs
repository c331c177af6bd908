// `f64`, which stays itself, is mixed with `Real`, which the run chooses.
use xca_core::prelude::*;


#[derive(Substates, Clone, Copy)]
struct Clock {
    time: f64,
    step: Real,
}

#[elementary_process]
fn process(clock: &mut Cell<Clock>) {
    clock.time = clock.step;
}

fn main() {}
