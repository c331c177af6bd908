//! Processes made at random: whatever is written must be accepted by naga.
//!
//! They are well typed but senseless, with blocks, branches and loops as values, shadowed names and mixed
//! types everywhere. The environment variable `SEEDS` says how many are made.

mod expressions;
mod source;
mod state;
mod statements;

use crate::common::validate;
use source::Source;
use state::SCHEMA;
use xca_core::ir::{Argument, Function, FunctionKind, Role};
use xca_core::prelude::*;
use xca_wgsl::{Options, shader};

#[test]
fn whatever_is_written_is_valid() {
    for seed in 0..std::env::var("SEEDS").map_or(300, |text| text.parse().unwrap()) {
        let mut source = Source::new(seed);
        let body = source.block(None, 5);
        let process = Function {
            name: "senseless",
            module: "wgsl::random",
            kind: FunctionKind::Cells,
            arguments: vec![Argument { name: "cell", role: Role::Cell(SCHEMA) }],
            result: None,
            body,
        };
        for precision in [Precision::F32, Precision::F64] {
            let options = Options { precision, neighbourhood_size: Some(7), ..Options::default() };
            match shader(&process, &options) {
                Ok(shader) => drop(validate(&shader)),
                Err(error) => panic!("seed {seed}: {error}\n{process:#?}"),
            }
        }
    }
}
