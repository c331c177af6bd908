//! The program: `cargo run --release -- run`. `cargo run --release -- --help` lists the other commands.

use new_model::{Health, Person};
use xca::prelude::*;

/// What a run writes to `observables.csv`, and shows at its end.
fn people(state: &State<'_>) -> Result<Vec<Observable>, Failure> {
    Ok(vec![
        Observable::number("infected", state.count(Person::HEALTH, Health::Infected)? as f64),
        Observable::number("immune", state.count(Person::HEALTH, Health::Immune)? as f64),
    ])
}

fn main() -> ExitCode {
    xca::run::main_of!("new-model", "An epidemic", |_given| {
        Ok(SetUp::new(new_model::model()?, 200).observables(people))
    })
}
