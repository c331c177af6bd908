//! The largest errors of the functions of `xca_core::math`, and what a call takes: the tables of docs/mathematics.md.
#![allow(clippy::print_stdout, reason = "printing is what this program does")]

use std::error::Error;
use xca_core::Precision;
use xca_tests::mathematics::arguments::Family;
use xca_tests::mathematics::{Function, worst};

fn main() -> Result<(), Box<dyn Error>> {
    let samples = std::env::args().nth(1).map_or(Ok(100_000), |text| text.parse())?;
    for function in Function::ALL {
        for precision in [Precision::F32, Precision::F64] {
            for family in Family::ALL {
                let worst = worst(function, family, precision, samples, 7)?;
                println!(
                    "{:6} {precision} {family:?}: {:.3} ulp at {:?} ({} samples)",
                    function.name(),
                    worst.ulp,
                    worst.arguments,
                    worst.samples,
                );
            }
        }
    }
    Ok(())
}
