//! Spots and stripes of Gray and Scott: two substances that react and diffuse.
use xca_examples::models::reaction::{Mixture, Rates, model};
use xca_run::prelude::*;

/// The second substance in a few random squares.
fn begin(site: Site) -> Mixture {
    let [x, y, _] = site.cell();
    let is_seeded = (x / 8 * 37 + y / 8 * 101) % 89 == 0;
    if is_seeded { Mixture { u: 0.5, v: 0.25 + 0.1 * site.random(0) } } else { Mixture { u: 1.0, v: 0.0 } }
}

fn main() -> ExitCode {
    xca_run::main_of!("reaction", "Spots and stripes by reaction and diffusion", |_given| {
        let view = CellView::named("reaction").draw(Mixture::V, "share of v");
        Ok(SetUp::new(model(256, Rates::default(), begin)?, 8000).cells(view))
    })
}
