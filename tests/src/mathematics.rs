//! The mathematical functions of `xca_core::math` against numbers of many digits.

pub mod arguments;
pub mod exact;
mod function;

pub use function::Function;

use arguments::Family;
use xca_core::engine::Engine;
use xca_core::math::{atan, atan2, cos, exp, log, pow, sin, tan, tanh};
use xca_core::prelude::*;

/// Two arguments, and the values of all functions.
#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
pub struct Values {
    /// The first argument.
    pub x: Real,
    /// The second argument.
    pub y: Real,
    /// `exp(x)`
    pub exp: Real,
    /// `log(x)`
    pub log: Real,
    /// `pow(x, y)`
    pub pow: Real,
    /// `sin(x)`
    pub sin: Real,
    /// `cos(x)`
    pub cos: Real,
    /// `tan(x)`
    pub tan: Real,
    /// `atan(x)`
    pub atan: Real,
    /// `atan2(x, y)`
    pub atan2: Real,
    /// `tanh(x)`
    pub tanh: Real,
    /// `exp2(x)`
    pub exp2: Real,
    /// `exp_m1(x)`
    pub exp_m1: Real,
    /// `log2(x)`
    pub log2: Real,
    /// `log10(x)`
    pub log10: Real,
    /// `log_1p(x)`
    pub log_1p: Real,
    /// `cbrt(x)`
    pub cbrt: Real,
    /// `hypot(x, y)`
    pub hypot: Real,
    /// `asin(x)`
    pub asin: Real,
    /// `acos(x)`
    pub acos: Real,
    /// `sinh(x)`
    pub sinh: Real,
    /// `cosh(x)`
    pub cosh: Real,
}

/// The values of the first half of the functions.
#[elementary_process]
pub fn compute(cell: &mut Cell<Values>) {
    cell.exp = exp(cell.x);
    cell.log = log(cell.x);
    cell.pow = pow(cell.x, cell.y);
    cell.sin = sin(cell.x);
    cell.cos = cos(cell.x);
    cell.tan = tan(cell.x);
    cell.atan = atan(cell.x);
    cell.atan2 = atan2(cell.x, cell.y);
    cell.tanh = tanh(cell.x);
}

/// The values of the second half, by the methods of numbers.
#[elementary_process]
pub fn compute_others(cell: &mut Cell<Values>) {
    cell.exp2 = cell.x.exp2();
    cell.exp_m1 = cell.x.exp_m1();
    cell.log2 = cell.x.log2();
    cell.log10 = cell.x.log10();
    cell.log_1p = cell.x.ln_1p();
    cell.cbrt = cell.x.cbrt();
    cell.hypot = cell.x.hypot(cell.y);
    cell.asin = cell.x.asin();
    cell.acos = cell.x.acos();
    cell.sinh = cell.x.sinh();
    cell.cosh = cell.x.cosh();
}

/// A model that computes all functions of these arguments in its first step.
///
/// # Errors
/// Where there are no arguments.
pub fn model(arguments: Vec<[f64; 2]>) -> Result<Model, ModelError> {
    Model::builder("functions")
        .extents([arguments.len(), 1, 1])
        .substates::<Values>()
        .process(compute)
        .process(compute_others)
        .fill(move |site| {
            let [x, y] = arguments[site.cell()[0]];
            Values { x, y, ..Values::default() }
        })
        .build()
}

/// Two arguments as the precision has them, and the value of a function.
pub type Sample = ([f64; 2], f64);

/// The arguments and the values of one function.
///
/// # Errors
/// What the run ends with.
pub fn values(
    function: Function,
    arguments: Vec<[f64; 2]>,
    engine: &dyn Engine,
    precision: Precision,
) -> Result<Vec<Sample>, Box<dyn std::error::Error>> {
    let model = model(arguments)?;
    let mut simulation = Simulation::new(&model, engine, RunOptions { precision, ..RunOptions::default() })?;
    simulation.step()?;
    let result = match function {
        Function::Exp => Values::EXP,
        Function::Log => Values::LOG,
        Function::Pow => Values::POW,
        Function::Sin => Values::SIN,
        Function::Cos => Values::COS,
        Function::Tan => Values::TAN,
        Function::Atan => Values::ATAN,
        Function::Atan2 => Values::ATAN2,
        Function::Tanh => Values::TANH,
        Function::Exp2 => Values::EXP2,
        Function::ExpM1 => Values::EXP_M1,
        Function::Log2 => Values::LOG2,
        Function::Log10 => Values::LOG10,
        Function::Log1p => Values::LOG_1P,
        Function::Cbrt => Values::CBRT,
        Function::Hypot => Values::HYPOT,
        Function::Asin => Values::ASIN,
        Function::Acos => Values::ACOS,
        Function::Sinh => Values::SINH,
        Function::Cosh => Values::COSH,
    };
    let state = simulation.state();
    let read = |substate| state.read(substate);
    let arguments = read(Values::X)?.into_iter().zip(read(Values::Y)?).map(|(x, y)| [x, y]);
    Ok(arguments.zip(read(result)?).collect())
}

/// The largest error of some values.
#[derive(Debug, Clone, Copy, Default)]
pub struct Worst {
    /// In units of the last digit of the exact value.
    pub ulp: f64,
    /// Where.
    pub arguments: [f64; 2],
    /// How many values were compared.
    pub samples: usize,
}

/// The largest error of a function over so many arguments of each kind.
///
/// # Errors
/// What the run ends with.
pub fn worst(
    function: Function,
    family: Family,
    precision: Precision,
    samples: usize,
    seed: u64,
) -> Result<Worst, Box<dyn std::error::Error>> {
    let arguments = arguments::sample(function, family, precision, samples, seed);
    let mut oracle = exact::Oracle::new(precision);
    let mut worst = Worst::default();
    for (arguments, value) in values(function, arguments, &Reference, precision)? {
        let Some(ulp) = oracle.error(function, arguments, value) else { continue };
        worst.samples += 1;
        if ulp > worst.ulp {
            worst.ulp = ulp;
            worst.arguments = arguments;
        }
    }
    Ok(worst)
}

/// The largest error of a function of one argument in `f32`, over every so many of all numbers, by the
/// platform's function in `f64`. Angles go to 4096.
///
/// # Errors
/// What the run ends with.
pub fn sweep(function: Function, step: usize) -> Result<Worst, Box<dyn std::error::Error>> {
    const CELLS: usize = 1 << 20;
    let (platform, limit): (fn(f64) -> f64, f64) = match function {
        Function::Exp => (f64::exp, f64::MAX),
        Function::Log => (f64::ln, f64::MAX),
        Function::Sin => (f64::sin, 4096.0),
        Function::Cos => (f64::cos, 4096.0),
        Function::Tan => (f64::tan, 4096.0),
        Function::Atan => (f64::atan, f64::MAX),
        Function::Tanh => (f64::tanh, f64::MAX),
        Function::Exp2 => (f64::exp2, f64::MAX),
        Function::ExpM1 => (f64::exp_m1, f64::MAX),
        Function::Log2 => (f64::log2, f64::MAX),
        Function::Log10 => (f64::log10, f64::MAX),
        Function::Log1p => (f64::ln_1p, f64::MAX),
        Function::Cbrt => (f64::cbrt, f64::MAX),
        Function::Asin => (f64::asin, f64::MAX),
        Function::Acos => (f64::acos, f64::MAX),
        Function::Sinh => (f64::sinh, f64::MAX),
        Function::Cosh => (f64::cosh, f64::MAX),
        Function::Pow | Function::Atan2 | Function::Hypot => {
            return Err("this function has two arguments".into());
        }
    };
    let numbers: Vec<u32> = (0..=u32::MAX).step_by(step).collect();
    let mut worst = Worst::default();
    for bits in numbers.chunks(CELLS) {
        let arguments: Vec<[f64; 2]> = bits
            .iter()
            .map(|bits| f64::from(f32::from_bits(*bits)))
            .filter(|x| x.abs() <= limit)
            .map(|x| [x, 1.0])
            .collect();
        if arguments.is_empty() {
            continue;
        }
        for (arguments, value) in values(function, arguments, &Reference, Precision::F32)? {
            let exact = platform(arguments[0]);
            let overflows = exact.abs() > f32::MAX.into() && value.is_infinite();
            if !exact.is_finite() || exact == 0.0 || overflows {
                continue;
            }
            worst.samples += 1;
            let unit = 2_f64.powi((exact.abs().log2().floor() as i32 - 23).max(-149));
            let ulp = (value - exact).abs() / unit;
            if ulp.is_nan() || ulp > worst.ulp {
                worst.ulp = ulp;
                worst.arguments = arguments;
            }
        }
    }
    Ok(worst)
}
