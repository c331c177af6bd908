//! The abelian sandpile: a heap on one cell topples until it is stable.
use xca_examples::models::sandpile::{Pile, model};
use xca_run::prelude::*;

#[derive(Args)]
struct Sandpile {
    /// Grains on the cell in the middle
    #[arg(long, value_name = "N", default_value_t = 1 << 15)]
    grains: u32,
    /// Cells along a side of the table
    #[arg(long, value_name = "N", default_value_t = 161, value_parser = whole_number)]
    size: usize,
}

impl Program for Sandpile {
    const NAME: &'static str = "sandpile";
    const ABOUT: &'static str = "A heap of grains that topples until it is stable";
    const EXAMPLES: &'static str = "--grains 100000 --size 261";

    fn set_up(&self, _given: Given) -> Result<SetUp, Failure> {
        let colours = [(0, [250, 250, 245]), (1, [130, 190, 230]), (2, [240, 180, 60]), (3, [120, 30, 40])];
        let view = CellView::named("sandpile")
            .draw(Pile::GRAINS, "grains")
            .kinds(&[(0_u32, "0 grains"), (1, "1"), (2, "2"), (3, "3")])
            .colours(Pile::GRAINS, &colours);
        let observe = |state: &State<'_>| {
            let (there, lost) = (state.sum(Pile::GRAINS)? as f64, state.sum(Pile::LOST)? as f64);
            Ok(vec![
                Observable::number("grains", there + lost).conserved(),
                Observable::number("lost", lost),
                Observable::number("unstable", state.count_where(|pile: &Pile| pile.grains > 3)? as f64),
            ])
        };
        Ok(SetUp::until_stopped(model(self.size, self.grains)?, 1_000_000).observables(observe).cells(view))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Sandpile)
}
