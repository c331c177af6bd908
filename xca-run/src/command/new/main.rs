//! The program: `cargo run --release -- run`, and `cargo run -- --help` for all else that it can do.

use xca_run::prelude::*;

fn main() -> ExitCode {
    xca_run::main_of!("new-model", "An excitable medium", |_given| Ok(SetUp::new(new_model::model()?, 200)))
}
