// Checks for NaN and infinities: a number in place of a schedule, a name in place of a substate.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
}

fn main() {
    let _ = Model::builder("a").watch_finite(10);
    let _ = Model::builder("b").watch_finite();
    let _ = Model::builder("c").allow_non_finite("temperature");
}
