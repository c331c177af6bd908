// A computation whose struct is not said, is none of parameters, or is not given to change.
use xca_core::prelude::*;

#[derive(Parameters, Clone, Debug)]
struct Flow {
    speed: Real,
    #[parameter(computed)]
    share: Real,
}

struct Other {
    share: f64,
}

fn main() {
    let _ = Model::builder("a").compute_parameters(|flow| flow.share = 2.0 * flow.speed);
    let _ = Model::builder("b").compute_parameters(|other: &mut Other| other.share = 2.0);
    let _ = Model::builder("c").compute_parameters(|flow: &Flow| 2.0 * flow.speed);
    let _ = Model::builder("d").parameters(Other { share: 1.0 });
}
