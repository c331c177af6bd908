//! Waves in an excitable medium: spirals out of a random start.
use xca_examples::models::excitable::{Medium, Tissue, model};
use xca_run::prelude::*;

/// Mostly resting, with a few broken fronts.
fn begin(site: Site) -> Tissue {
    match site.random_bits(0) % 64 {
        0 => Tissue::Excited,
        1 => Tissue::Refractory,
        _ => Tissue::Resting,
    }
}

fn main() -> ExitCode {
    xca_run::main_of!("excitable", "Waves in an excitable medium", |_given| {
        let colours = [
            (Tissue::Resting, [240, 240, 235]),
            (Tissue::Excited, [200, 50, 40]),
            (Tissue::Refractory, [240, 170, 90]),
        ];
        let view = CellView::named("excitable").colours(Medium::TISSUE, &colours);
        Ok(SetUp::new(model(256, begin)?, 200).cells(view))
    })
}
