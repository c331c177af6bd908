//! A program with an engine and a format of its own.

mod engine;
mod format;

use engine::Twins;
use format::Json;
use xca::prelude::*;
use xca::run::CommandLine;

#[derive(Substates, Clone)]
struct Plate {
    temperature: Real,
}

#[elementary_process]
fn conduct(cell: &mut Cell<Plate>) {
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        sum += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature += 0.2 * sum;
}

fn set_up() -> Result<SetUp, Failure> {
    let model = Model::builder("plate")
        .extents([24, 16, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .substates::<Plate>()
        .process(conduct)
        .fill(|site| Plate { temperature: if site.cell()[0] < 12 { 100.0 } else { 0.0 } })
        .build()?;
    Ok(SetUp::new(model, 40).format(Json::default()))
}

fn main() -> ExitCode {
    let version = env!("CARGO_PKG_VERSION");
    CommandLine::of_model("plate", "A plate that cools down", version, |_| set_up()).engine(Twins).main()
}
