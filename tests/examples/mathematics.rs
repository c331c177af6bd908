//! The largest errors of the functions of `xca_core::math`, as in the table of docs/mathematics.md.
//!
//! `-- 100000` compares so many values of each kind with numbers of many digits, `-- sweep 13` every
//! thirteenth number of `f32` with the platform's functions in `f64`.
#![allow(clippy::print_stdout, reason = "printing is what this program does")]

use std::error::Error;
use xca_core::Precision;
use xca_tests::mathematics::arguments::Family;
use xca_tests::mathematics::{Function, Worst, sweep, worst};

fn show(function: Function, what: &str, worst: &Worst) {
    let Worst { ulp, arguments, samples } = worst;
    println!("{} {what}: {ulp:.3} ulp at {arguments:?} ({samples} values)", function.name());
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let first = arguments.next().unwrap_or_else(|| "10000".to_owned());
    if first == "sweep" {
        let step = arguments.next().map_or(Ok(1013), |text| text.parse())?;
        for function in Function::ALL {
            if ![Function::Pow, Function::Atan2, Function::Hypot].contains(&function) {
                show(function, "sweep", &sweep(function, step)?);
            }
        }
        return Ok(());
    }
    let samples = first.parse()?;
    for function in Function::ALL {
        for precision in [Precision::F32, Precision::F64] {
            for family in Family::ALL {
                let worst = worst(function, family, precision, samples, 7)?;
                show(function, &format!("{precision} {family:?}").to_lowercase(), &worst);
            }
        }
    }
    Ok(())
}
