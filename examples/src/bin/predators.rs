//! Predators hunt prey over a meadow: both wander at random, and chase each other in waves.
use xca_examples::models::predators::{Ecology, Inhabitants, Meadow, Predator, Prey, Shares, model};
use xca_run::prelude::*;

/// Cells along a side.
const SIZE: usize = 96;

/// Prey everywhere, and predators in the middle.
fn share_alive(site: &Site) -> Shares {
    let away = site.cell().map(|index| index.abs_diff(SIZE / 2));
    Shares { prey: 0.8, predators: if away[0] < 8 && away[1] < 8 { 0.5 } else { 0.0 } }
}

fn main() -> ExitCode {
    xca_run::main_of!("predators", "Predators and prey that wander over a meadow", |_given| {
        let colours = [
            (Inhabitants::Nobody, [238, 232, 205]),
            (Inhabitants::Prey, [90, 160, 80]),
            (Inhabitants::Predators, [190, 50, 40]),
            (Inhabitants::Both, [110, 60, 120]),
        ];
        let view = CellView::named("predators").draw(Meadow::INHABITANTS, "who lives in a cell");
        let view = view.colours(Meadow::INHABITANTS, &colours);
        let observe = |state: &State<'_>| {
            Ok(vec![
                Observable::number("prey", state.count_where(|prey: &Prey| prey.alive)? as f64),
                Observable::number("predators", state.count_where(|one: &Predator| one.alive)? as f64),
            ])
        };
        let model = model(SIZE, Ecology::default(), share_alive)?;
        Ok(SetUp::new(model, 80).observables(observe).cells(view))
    })
}
