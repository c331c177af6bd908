//! The functions of `xca_core::math`: their errors, their special values, and the same bits everywhere.

use std::error::Error;
use std::fs;
use xca_core::Snapshot;
use xca_core::math;
use xca_core::prelude::*;
use xca_tests::mathematics::arguments::{Family, sample};
use xca_tests::mathematics::exact::Oracle;
use xca_tests::mathematics::{Function, Values, model, sweep, values, worst};
use xca_tests::suite::engines::{self, PRECISIONS};

type TestResult = Result<(), Box<dyn Error>>;

/// The largest error that docs/mathematics.md promises.
fn promised(function: Function, precision: Precision) -> Result<f64, Box<dyn Error>> {
    let document = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/mathematics.md"))?;
    let start = format!("| `{}(", function.name());
    let row = document.lines().find(|line| line.starts_with(&start)).ok_or("no such row")?;
    let cells: Vec<&str> = row.split('|').map(str::trim).collect();
    let cell = match precision {
        Precision::F32 => cells[2],
        Precision::F64 => cells[3],
    };
    Ok(cell.parse()?)
}

#[test]
fn errors_are_as_small_as_documented() -> TestResult {
    for function in Function::ALL {
        for precision in PRECISIONS {
            let promised = promised(function, precision)?;
            assert!(promised <= 2.0, "{function:?}");
            for family in Family::ALL {
                let worst = worst(function, family, precision, 500, 1)?;
                assert!(worst.samples > 100, "{function:?} {family:?}: {worst:?}");
                assert!(worst.ulp <= promised, "{function:?} {precision} {family:?}: {worst:?}");
                // A correctly rounded function would have half a unit; one far better is not measured at all.
                assert!(worst.ulp > 0.4, "{function:?} {precision} {family:?}: {worst:?}");
            }
        }
    }
    Ok(())
}

/// The same in `f32`, by another measure: all magnitudes, against the platform's functions in `f64`.
#[test]
fn a_sweep_through_all_magnitudes_finds_no_larger_error() -> TestResult {
    for function in Function::ALL {
        if [Function::Pow, Function::Atan2, Function::Hypot].contains(&function) {
            continue;
        }
        let worst = sweep(function, 100_003)?;
        let promised = promised(function, Precision::F32)?;
        assert!(worst.samples > 15_000 && worst.ulp > 0.4, "{function:?}: {worst:?}");
        assert!(worst.ulp <= promised, "{function:?}: {worst:?}");
    }
    Ok(())
}

/// Beyond the range of full accuracy the error is small beside 1, though not beside a result near zero.
#[test]
fn large_angles_have_a_small_absolute_error() -> TestResult {
    for precision in PRECISIONS {
        let (from, to): (f64, f64) = match precision {
            Precision::F32 => (4096.0, 16_777_216.0),
            Precision::F64 => (1_048_576.0, 1_099_511_627_776.0),
        };
        for function in [Function::Sin, Function::Cos] {
            let arguments: Vec<[f64; 2]> = sample(function, Family::Usual, precision, 2000, 3)
                .into_iter()
                .map(|[x, _]| [x.signum() * from * (to / from).powf(x.abs() / 6.3), 1.0])
                .collect();
            let mut oracle = Oracle::new(precision);
            for (arguments, value) in values(function, arguments, &Reference, precision)? {
                let ulp = oracle.error(function, arguments, value).ok_or("an exact value")?;
                let beside_one = ulp * 2_f64.powf(value.abs().log2().floor());
                assert!(beside_one < 1.0, "{function:?} {precision} {arguments:?}: {ulp}");
            }
        }
    }
    Ok(())
}

/// Arguments at which C says what the functions give.
const SPECIAL: [f64; 27] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -2.0,
    3.0,
    -3.0,
    1.5,
    -1.5,
    1e-40,
    -1e-40,
    1e-20,
    700.25,
    -700.25,
    16_777_215.0,
    -16_777_215.0,
    16_777_216.0,
    1e30,
    -1e30,
    5e-324,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// What the platform gives, whose special values are those of C.
fn of_the_platform(function: Function, precision: Precision, [x, y]: [f64; 2]) -> f64 {
    macro_rules! value {
        ($x:expr, $y:expr) => {
            match function {
                Function::Exp => $x.exp(),
                Function::Log => $x.ln(),
                Function::Pow => $x.powf($y),
                Function::Sin => $x.sin(),
                Function::Cos => $x.cos(),
                Function::Tan => $x.tan(),
                Function::Atan => $x.atan(),
                Function::Atan2 => $x.atan2($y),
                Function::Tanh => $x.tanh(),
                Function::Exp2 => $x.exp2(),
                Function::ExpM1 => $x.exp_m1(),
                Function::Log2 => $x.log2(),
                Function::Log10 => $x.log10(),
                Function::Log1p => $x.ln_1p(),
                Function::Cbrt => $x.cbrt(),
                Function::Hypot => $x.hypot($y),
                Function::Asin => $x.asin(),
                Function::Acos => $x.acos(),
                Function::Sinh => $x.sinh(),
                Function::Cosh => $x.cosh(),
            }
        };
    }
    match precision {
        Precision::F32 => {
            let (x, y) = (x as f32, y as f32);
            value!(x, y).into()
        }
        Precision::F64 => value!(x, y),
    }
}

/// Zeros with their signs, infinities, NaN, overflow and underflow are those of C, for all pairs.
#[test]
fn special_values_are_those_of_c() -> TestResult {
    let pairs: Vec<[f64; 2]> = SPECIAL.iter().flat_map(|x| SPECIAL.map(|y| [*x, y])).collect();
    for function in Function::ALL {
        for precision in PRECISIONS {
            let (limit, close) = match precision {
                Precision::F32 => (16_777_216.0, 1e-6),
                Precision::F64 => (1_099_511_627_776.0, 1e-15),
            };
            let angles = [Function::Sin, Function::Cos, Function::Tan].contains(&function);
            for (arguments, value) in values(function, pairs.clone(), &Reference, precision)? {
                let wanted = match arguments[0].abs() > limit && angles {
                    // As the documentation says.
                    true => f64::NAN,
                    false => of_the_platform(function, precision, arguments),
                };
                let place = format!("{function:?} {precision} {arguments:?}: {value:?}, not {wanted:?}");
                if wanted.is_nan() || value.is_nan() {
                    assert!(wanted.is_nan() && value.is_nan(), "{place}");
                } else if wanted == 0.0 || wanted.is_infinite() {
                    assert_eq!(wanted.to_bits(), value.to_bits(), "{place}");
                } else {
                    let smallest = if precision == Precision::F32 { 1e-44 } else { 1e-323 };
                    assert!((value - wanted).abs() <= close * wanted.abs() + smallest, "{place}");
                }
            }
        }
    }
    Ok(())
}

fn mixed_arguments(precision: Precision) -> Vec<[f64; 2]> {
    let mut arguments: Vec<[f64; 2]> = SPECIAL.iter().flat_map(|x| SPECIAL.map(|y| [*x, y])).collect();
    for function in Function::ALL {
        for family in Family::ALL {
            arguments.extend(sample(function, family, precision, 200, 5));
        }
    }
    arguments
}

#[test]
fn every_engine_gives_the_same_bits() -> TestResult {
    let all = engines::all()?;
    for precision in PRECISIONS {
        let model = model(mixed_arguments(precision))?;
        let options = RunOptions { precision, ..RunOptions::default() };
        engines::assert_same_runs(&model, engines::on_processors(&all), options, 1)?;
        let after_a_step = |engine: &dyn Engine| -> Result<Snapshot, RunError> {
            let mut simulation = Simulation::new(&model, engine, options)?;
            simulation.step()?;
            Ok(engines::with_one_nan(&model, precision, simulation.snapshot()?))
        };
        let (wanted, found) = (after_a_step(&Reference)?, after_a_step(&engines::gpu()?)?);
        engines::assert_same_state(&wanted, &found, &|| format!("the gpu in {precision}"));
    }
    Ok(())
}

/// In ordinary code the functions are those of a run in `f64`.
#[test]
fn ordinary_code_gives_the_same_bits() -> TestResult {
    let model = model(mixed_arguments(Precision::F64))?;
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    simulation.step()?;
    let state = simulation.state();
    let [x, y] = [state.read(Values::X)?, state.read(Values::Y)?];
    let check = |substate: Substate<Values, f64>, function: fn(f64, f64) -> f64| -> TestResult {
        for (index, value) in state.read(substate)?.into_iter().enumerate() {
            let own: f64 = function(x[index], y[index]);
            let same = own.to_bits() == value.to_bits() || (own.is_nan() && value.is_nan());
            assert!(same, "{} {}: {own:?} {value:?}", x[index], y[index]);
        }
        Ok(())
    };
    check(Values::EXP, |x, _| math::exp(x))?;
    check(Values::LOG, |x, _| math::log(x))?;
    check(Values::POW, math::pow)?;
    check(Values::SIN, |x, _| math::sin(x))?;
    check(Values::COS, |x, _| math::cos(x))?;
    check(Values::TAN, |x, _| math::tan(x))?;
    check(Values::ATAN, |x, _| math::atan(x))?;
    check(Values::ATAN2, math::atan2)?;
    check(Values::TANH, |x, _| math::tanh(x))?;
    check(Values::EXP2, |x, _| math::exp2(x))?;
    check(Values::EXP_M1, |x, _| math::exp_m1(x))?;
    check(Values::LOG2, |x, _| math::log2(x))?;
    check(Values::LOG10, |x, _| math::log10(x))?;
    check(Values::LOG_1P, |x, _| math::log_1p(x))?;
    check(Values::CBRT, |x, _| math::cbrt(x))?;
    check(Values::HYPOT, math::hypot)?;
    check(Values::ASIN, |x, _| math::asin(x))?;
    check(Values::ACOS, |x, _| math::acos(x))?;
    check(Values::SINH, |x, _| math::sinh(x))?;
    check(Values::COSH, |x, _| math::cosh(x))?;
    Ok(())
}

/// Results that a number of the type is exactly.
#[test]
fn exact_results_are_exact() {
    for n in -40..=40 {
        assert_eq!(math::pow(2.0, f64::from(n)), 2_f64.powi(n));
        assert_eq!(math::pow(f64::from(n), 2.0), f64::from(n * n));
        assert_eq!(math::pow(f64::from(n * n), 0.5), f64::from(n.abs()));
    }
    assert_eq!(math::pow(10.0, 15.0), 1e15);
    assert_eq!(math::pow(-3.0, 33.0), -5_559_060_566_555_523.0);
    assert_eq!(math::exp(0.0), 1.0);
    assert_eq!(math::log(1.0), 0.0);
    assert_eq!(math::cos(0.0), 1.0);
    assert_eq!(4.0 * math::atan(1.0), std::f64::consts::PI);
}
