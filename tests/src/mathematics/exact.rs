//! The exact values, from a library of numbers with many digits.

use super::function::Function;
use astro_float::{BigFloat, Consts, RoundingMode};
use xca_core::Precision;

/// Digits of the exact values; some cancel.
const DIGITS: usize = 256;
const ROUNDING: RoundingMode = RoundingMode::ToEven;

/// Measures errors in one precision.
#[derive(Debug)]
pub struct Oracle {
    constants: Consts,
    /// Digits of the type.
    digits: i32,
    /// The exponent of its smallest number.
    smallest: i32,
    largest: f64,
}

impl Oracle {
    /// For one precision.
    ///
    /// # Panics
    /// Where the library finds no memory.
    pub fn new(precision: Precision) -> Self {
        let constants = Consts::new().expect("memory for some constants");
        match precision {
            Precision::F32 => Self { constants, digits: 24, smallest: -149, largest: f32::MAX.into() },
            Precision::F64 => Self { constants, digits: 53, smallest: -1074, largest: f64::MAX },
        }
    }

    /// The error of a value in units of the last digit of the exact one. Nothing where the exact value is no
    /// number, or zero; infinite where one of the two is infinite or NaN, and the other should not be.
    pub fn error(&mut self, function: Function, arguments: [f64; 2], value: f64) -> Option<f64> {
        let exact = self.value(function, arguments);
        if exact.is_nan() || exact.is_inf() || exact.is_zero() {
            return None;
        }
        let exponent = exact.exponent()? - 1;
        let unit = (exponent - (self.digits - 1)).max(self.smallest);
        if value.is_infinite() {
            // Right where the exact value rounds to it: beyond the largest number and half a digit.
            let sign = exact.is_negative() == value.is_sign_negative();
            let rest = exact.abs().sub(&number(self.largest), DIGITS, ROUNDING);
            let beyond = rest.is_positive() && exponent >= 127 && as_f64(&rest, unit.min(970)) >= 0.5;
            return Some(if sign && beyond { 0.0 } else { f64::INFINITY });
        }
        if !value.is_finite() {
            return Some(f64::INFINITY);
        }
        Some(as_f64(&exact.sub(&number(value), DIGITS, ROUNDING), unit).abs())
    }

    fn value(&mut self, function: Function, [x, y]: [f64; 2]) -> BigFloat {
        let constants = &mut self.constants;
        let [big_x, big_y] = [x, y].map(number);
        match function {
            Function::Exp => big_x.exp(DIGITS, ROUNDING, constants),
            Function::Log => big_x.ln(DIGITS, ROUNDING, constants),
            Function::Pow => {
                // The library's own power does not end where the result is nearly exact.
                let logarithm = big_x.abs().ln(DIGITS, ROUNDING, constants);
                let power = big_y.mul(&logarithm, DIGITS, ROUNDING).exp(DIGITS, ROUNDING, constants);
                if x < 0.0 && y % 2.0 != 0.0 { power.neg() } else { power }
            }
            Function::Sin => big_x.sin(DIGITS, ROUNDING, constants),
            Function::Cos => big_x.cos(DIGITS, ROUNDING, constants),
            Function::Tan => big_x.tan(DIGITS, ROUNDING, constants),
            Function::Atan => big_x.atan(DIGITS, ROUNDING, constants),
            Function::Atan2 => {
                let angle = big_x.div(&big_y, DIGITS, ROUNDING).atan(DIGITS, ROUNDING, constants);
                if y > 0.0 {
                    return angle;
                }
                let half_turn = constants.pi(DIGITS, ROUNDING);
                let half_turn = if x < 0.0 { half_turn.neg() } else { half_turn };
                angle.add(&half_turn, DIGITS, ROUNDING)
            }
            Function::Tanh => big_x.tanh(DIGITS, ROUNDING, constants),
            // Smaller numbers are their own value, to more digits than are kept.
            Function::ExpM1 | Function::Log1p | Function::Sinh | Function::Asin if x.abs() < 1e-30 => big_x,
            Function::Exp2 => {
                let product = big_x.mul(&constants.ln_2(DIGITS, ROUNDING), DIGITS, ROUNDING);
                product.exp(DIGITS, ROUNDING, constants)
            }
            Function::ExpM1 => big_x.exp(DIGITS, ROUNDING, constants).sub(&number(1.0), DIGITS, ROUNDING),
            Function::Log2 => {
                big_x.ln(DIGITS, ROUNDING, constants).div(&constants.ln_2(DIGITS, ROUNDING), DIGITS, ROUNDING)
            }
            Function::Log10 => {
                let base = number(10.0).ln(DIGITS, ROUNDING, constants);
                big_x.ln(DIGITS, ROUNDING, constants).div(&base, DIGITS, ROUNDING)
            }
            Function::Log1p => big_x.add(&number(1.0), DIGITS, ROUNDING).ln(DIGITS, ROUNDING, constants),
            Function::Cbrt => big_x.cbrt(DIGITS, ROUNDING),
            Function::Hypot => {
                let [x, y] = [big_x, big_y].map(|side| side.mul(&side, DIGITS, ROUNDING));
                x.add(&y, DIGITS, ROUNDING).sqrt(DIGITS, ROUNDING)
            }
            Function::Asin => big_x.asin(DIGITS, ROUNDING, constants),
            Function::Acos => big_x.acos(DIGITS, ROUNDING, constants),
            Function::Sinh => big_x.sinh(DIGITS, ROUNDING, constants),
            Function::Cosh => big_x.cosh(DIGITS, ROUNDING, constants),
        }
    }
}

fn number(value: f64) -> BigFloat {
    if value.is_normal() {
        return BigFloat::from_f64(value, DIGITS);
    }
    // The library takes denormal numbers for others; 2^-100 times a normal one is what they are.
    let normal = BigFloat::from_f64(value * 2_f64.powi(100), DIGITS);
    normal.mul(&BigFloat::from_f64(2_f64.powi(-100), DIGITS), DIGITS, ROUNDING)
}

/// About `value / 2^unit`.
fn as_f64(value: &BigFloat, unit: i32) -> f64 {
    let Some((words, _, sign, exponent, _)) = value.as_raw_parts() else { return f64::NAN };
    let Some(first) = words.last() else { return 0.0 };
    let fraction = *first as f64 / 2_f64.powi(64);
    let size = fraction * 2_f64.powi((exponent - unit).clamp(-1000, 1000));
    if sign == astro_float::Sign::Neg { -size } else { size }
}
