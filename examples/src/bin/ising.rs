//! The Ising model near its critical temperature: `--set temperature=2` orders it, `--set temperature=3`
//! does not.
use xca_examples::models::ising::{Bath, Lattice, exact_magnetisation, model};
use xca_run::prelude::*;

fn main() -> ExitCode {
    xca_run::main_of!("ising", "The Ising model on a square lattice", |_given| {
        let view = CellView::named("ising")
            .draw(Lattice::SPIN, "spin")
            .kinds(&[(-1, "down"), (1, "up")])
            .colours(Lattice::SPIN, &[(-1, [35, 60, 110]), (1, [235, 225, 200])]);
        let observe = |state: &State<'_>| {
            let spins = state.geometry().cells() as f64;
            let exact = exact_magnetisation(state.parameters::<Bath>()?.temperature);
            Ok(vec![
                Observable::number("magnetisation", state.sum(Lattice::SPIN)? as f64 / spins),
                Observable::number("exact_magnetisation", exact),
            ])
        };
        Ok(SetUp::new(model(256, 2.27, 0.5)?, 600).observables(observe).cells(view))
    })
}
