//! Wolfram's elementary cellular automata in space and time.
use xca_examples::models::elementary::{Row, Rule, model};
use xca_run::prelude::*;

#[derive(Args)]
struct Elementary {
    /// The number of the rule, 0 to 255
    #[arg(long, value_name = "N", default_value_t = 30)]
    rule: u8,
    /// Cells in a row
    #[arg(long, value_name = "N", default_value_t = 401, value_parser = whole_number)]
    width: usize,
}

impl Program for Elementary {
    const NAME: &'static str = "elementary";
    const ABOUT: &'static str = "Elementary cellular automata in space and time";
    const EXAMPLES: &'static str = "--rule 90\n--rule 110 --width 800 --steps 600";

    fn set_up(&self, given: Given) -> Result<SetUp, Failure> {
        let middle = self.width / 2;
        let rule = given.applied_to(Rule { number: self.rule })?;
        let model = model(self.width, self.rule, move |x| x == middle)?;
        let view = CellView::named("elementary").draw(Row::ON, "cell is on");
        let view = view.colours(Row::ON, &[(false, [245, 245, 245]), (true, [20, 30, 60])]);
        let title = format!("rule {}", rule.number);
        Ok(SetUp::new(model, 200).every(1).title(title).cells(view))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Elementary)
}
