//! A fluid in a square cavity, driven by its lid. `--set reynolds=1000` makes it livelier.
use xca_examples::models::cavity::{Fluid, model};
use xca_run::prelude::*;

#[derive(Args)]
struct Cavity {
    /// Cells along a side
    #[arg(long, value_name = "N", default_value_t = 64)]
    size: u32,
}

impl Program for Cavity {
    const NAME: &'static str = "cavity";
    const ABOUT: &'static str = "A fluid in a square cavity, driven by its lid";
    const EXAMPLES: &'static str = "--set reynolds=1000 --steps 30000\n--size 128 --steps 40000";

    fn set_up(&self, _given: Given) -> Result<SetUp, Failure> {
        let view = CellView::named("cavity").draw(Fluid::VELOCITY, "speed (cells a step)");
        Ok(SetUp::new(model(self.size, 400.0)?, 12_000).cells(view))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Cavity)
}
