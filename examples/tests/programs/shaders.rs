//! Every process of the programs can be written as WGSL that naga accepts.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::error::Error;
use std::fs;
use xca_core::{ElementaryProcess, Precision};
use xca_wgsl::{Options, shader};

/// A program with the size of its neighbourhood and its processes; `count` says how many these are.
macro_rules! program {
    ($name:ident, $neighbours:literal, $($process:ident),+) => {
        #[allow(dead_code, reason = "only the processes are wanted")]
        mod $name {
            include!(concat!(env!("OUT_DIR"), "/", stringify!($name), ".rs"));

            pub(super) fn count() -> Result<usize, Box<dyn std::error::Error>> {
                Ok([$(super::accepted::<$process>($neighbours)?),+].len())
            }
        }
    };
}

program!(life, 9, evolve);
program!(mod2, 27, add_up);
program!(heat, 7, diffuse);
program!(pond, 5, flow, level, drift, reassign);

fn accepted<P: ElementaryProcess>(neighbours: u32) -> Result<(), Box<dyn Error>> {
    for precision in [Precision::F32, Precision::F64] {
        let options = Options { precision, neighbourhood_size: Some(neighbours), ..Options::default() };
        let shader = shader(&(P::process().body)(), &options)?;
        let module = naga::front::wgsl::parse_str(&shader.source)
            .map_err(|error| error.emit_to_string(&shader.source))?;
        let capabilities = if shader.needs_f64 { Capabilities::FLOAT64 } else { Capabilities::empty() };
        Validator::new(ValidationFlags::all(), capabilities)
            .validate(&module)
            .map_err(|error| error.emit_to_string(&shader.source))?;
    }
    Ok(())
}

#[test]
fn all_processes_are_valid_shaders() -> Result<(), Box<dyn Error>> {
    let mut there = 0;
    for entry in fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/src/bin"))? {
        let text = fs::read_to_string(entry?.path())?;
        there += text.lines().filter(|line| ["#[elementary_process]", "#[migration]"].contains(line)).count();
    }
    assert_eq!(
        life::count()? + mod2::count()? + heat::count()? + pond::count()?,
        there,
        "a program is missing here"
    );
    Ok(())
}
