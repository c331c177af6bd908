// Initial values of what is no struct of substates, of too few fields, with parameters of another type.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[derive(Parameters, Clone, Debug)]
struct Flow {
    speed: Real,
}

fn main() {
    let _ = Model::builder("a").fill(|_| 1.0);
    let _ = Model::builder("b").fill(|_| Heat { temperature: 1.0 });
    let _ = Model::builder("c").fill_with(|_, flow| Heat { temperature: flow.speed, kind: 1 });
    let _ = Model::builder("d").fill_with(|_, flow: Flow| Heat { temperature: flow.speed, kind: 1 });
    let _ = Model::builder("e").populate(|_| Heat { temperature: 1.0, kind: 1 });
}
