//! Arguments on which the functions are tried.

use super::function::Function;
use std::f64::consts::{FRAC_PI_2, PI};
use xca_core::{Precision, philox};

/// Where the arguments come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// From the range in which the function is mostly used.
    Usual,
    /// From all numbers of the type, every magnitude being as likely as any other.
    Wide,
    /// Where digits cancel: near multiples of a right angle, near 1, near the bounds between two formulas.
    Hard,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Usual, Self::Wide, Self::Hard];
}

/// A stream of random numbers in [0, 1).
struct Random {
    counter: u32,
    seed: u64,
}

impl Random {
    fn next(&mut self) -> f64 {
        self.counter += 1;
        let words = philox([self.counter, 0, 0, 0], [self.seed as u32, (self.seed >> 32) as u32]);
        (f64::from(words[0]) + f64::from(words[1]) / 4_294_967_296.0) / 4_294_967_296.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Any magnitude between two powers of two.
    fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        let exponent = self.between(low, high).floor();
        self.between(1.0, 2.0)
            * 2_f64.powi((exponent / 2.0).floor() as i32)
            * 2_f64.powi((exponent / 2.0).ceil() as i32)
    }

    fn signed(&mut self, value: f64) -> f64 {
        if self.next() < 0.5 { -value } else { value }
    }

    /// Some last digits of the type more or less.
    fn nudged(&mut self, value: f64, precision: Precision) -> f64 {
        let steps = self.between(-4.0, 4.0).round();
        match precision {
            Precision::F32 => {
                let single = value as f32;
                f64::from(single) + steps * f64::from(single.abs().next_up() - single.abs())
            }
            Precision::F64 => value + steps * (value.abs().next_up() - value.abs()),
        }
    }
}

/// What depends on the precision.
struct Limits {
    least_exponent: f64,
    greatest_exponent: f64,
    /// Angles up to this are reduced with all digits.
    angle: f64,
}

/// Arguments of a function, the same for the same seed.
pub fn sample(
    function: Function,
    family: Family,
    precision: Precision,
    samples: usize,
    seed: u64,
) -> Vec<[f64; 2]> {
    let limits = match precision {
        Precision::F32 => Limits { least_exponent: -149.0, greatest_exponent: 128.0, angle: 4096.0 },
        Precision::F64 => Limits { least_exponent: -1074.0, greatest_exponent: 1024.0, angle: 1_048_576.0 },
    };
    let mut random = Random { counter: 0, seed };
    (0..samples)
        .map(|_| {
            let [x, y] = arguments(&mut random, function, family, precision, &limits);
            match precision {
                Precision::F32 => [x as f32, y as f32].map(f64::from),
                Precision::F64 => [x, y],
            }
        })
        .collect()
}

fn arguments(
    random: &mut Random,
    function: Function,
    family: Family,
    precision: Precision,
    limits: &Limits,
) -> [f64; 2] {
    let any = |random: &mut Random| {
        let value = random.magnitude(limits.least_exponent, limits.greatest_exponent);
        random.signed(value)
    };
    let one = |x| [x, 1.0];
    match (function, family) {
        (Function::Exp, Family::Usual) => one(random.between(-20.0, 20.0)),
        (Function::Exp, Family::Wide) => {
            let bound = limits.greatest_exponent * 0.75;
            one(random.between(-1.1 * bound, bound))
        }
        (Function::Exp, Family::Hard) => {
            // Between two powers of two the reduced argument is largest.
            let turns = random.between(-100.0, 100.0).floor() + 0.5;
            one(random.nudged(turns * std::f64::consts::LN_2, precision))
        }
        (Function::Log | Function::Log2 | Function::Log10, Family::Usual) => one(random.between(0.01, 100.0)),
        (Function::Log | Function::Log2 | Function::Log10, Family::Wide) => one(any(random).abs()),
        (Function::Log | Function::Log2 | Function::Log10, Family::Hard) => {
            let distance = random.magnitude(-60.0, -1.0);
            one(1.0 + random.signed(distance))
        }
        (Function::Pow, Family::Usual) => [random.between(0.0, 10.0), random.between(-5.0, 5.0)],
        (Function::Pow, Family::Wide) => {
            let x = any(random).abs();
            let bound = limits.greatest_exponent * 0.7;
            [x, random.between(-1.05 * bound, bound) / x.ln()]
        }
        (Function::Pow, Family::Hard) => {
            let distance = random.magnitude(-30.0, -1.0);
            let x = 1.0 + random.signed(distance);
            let bound = limits.greatest_exponent * 0.7;
            let y = random.between(-1.05 * bound, bound) / x.ln();
            if random.next() < 0.5 { [-x, y.round()] } else { [x, y] }
        }
        (Function::Sin | Function::Cos | Function::Tan, Family::Usual) => {
            one(random.between(-2.0 * PI, 2.0 * PI))
        }
        (Function::Sin | Function::Cos | Function::Tan, Family::Wide) => {
            if random.next() < 0.5 {
                return one(random.between(-limits.angle, limits.angle));
            }
            let value = random.magnitude(limits.least_exponent, limits.angle.log2());
            one(random.signed(value))
        }
        (Function::Sin | Function::Cos | Function::Tan, Family::Hard) => {
            let turns = random.between(-limits.angle, limits.angle) / FRAC_PI_2;
            let halves = (2.0 * turns).round() / 2.0;
            one(random.nudged(halves * FRAC_PI_2, precision))
        }
        (Function::Atan, Family::Usual) => one(random.between(-5.0, 5.0)),
        (Function::Atan, Family::Wide) => one(any(random)),
        (Function::Atan, Family::Hard) => {
            let bound =
                [0.236, 0.25, 0.5, 0.72, 1.0, 1.0 / 0.72, 2.0, 1.0 / 0.236][(8.0 * random.next()) as usize];
            let near = random.between(0.98, 1.02) * bound;
            one(random.signed(near))
        }
        (Function::Atan2 | Function::Hypot, Family::Usual) => {
            [random.between(-1.0, 1.0), random.between(-1.0, 1.0)]
        }
        (Function::Atan2 | Function::Hypot, Family::Wide) => [any(random), any(random)],
        (Function::Atan2 | Function::Hypot, Family::Hard) => {
            let size = random.magnitude(limits.least_exponent / 2.0, limits.greatest_exponent / 2.0);
            let ratio = random.magnitude(-4.0, 4.0);
            [random.signed(size * ratio), random.signed(size)]
        }
        (Function::Exp2, Family::Usual) => one(random.between(-30.0, 30.0)),
        (Function::Exp2, Family::Wide) => {
            one(random.between(-1.1 * limits.greatest_exponent, limits.greatest_exponent))
        }
        (Function::Exp2, Family::Hard) => {
            let halves = random.between(-100.0, 100.0).floor() + 0.5;
            one(random.nudged(halves, precision))
        }
        (Function::Cbrt, Family::Usual) => one(random.between(-30.0, 30.0)),
        (Function::Cbrt, Family::Wide) => one(any(random)),
        (Function::Cbrt, Family::Hard) => {
            let cube = random.between(1.0, 100.0).floor().powi(3);
            one(random.nudged(cube, precision))
        }
        (Function::Asin | Function::Acos, Family::Usual) => one(random.between(-1.0, 1.0)),
        (Function::Log1p, Family::Usual) => one(random.between(-0.99, 10.0)),
        (Function::Sinh | Function::Cosh | Function::ExpM1, Family::Usual) => one(random.between(-5.0, 5.0)),
        // Small ones, and, every other time, those of an ordinary size or the largest ones.
        (
            Function::Asin
            | Function::Acos
            | Function::Log1p
            | Function::Sinh
            | Function::Cosh
            | Function::ExpM1,
            Family::Wide,
        ) => {
            let large = match function {
                Function::Asin | Function::Acos => random.between(-1.0, 1.0),
                Function::Log1p => any(random).abs(),
                _ => random.between(-0.69, 0.69) * limits.greatest_exponent,
            };
            let value = random.magnitude(limits.least_exponent, -1.0);
            if random.next() < 0.5 { one(large) } else { one(random.signed(value)) }
        }
        (Function::Asin | Function::Acos, Family::Hard) => {
            let near = 1.0 - random.magnitude(-24.0, -1.0);
            one(random.signed(near))
        }
        (Function::Log1p, Family::Hard) => {
            let near = random.magnitude(-60.0, -1.0);
            one(random.signed(near))
        }
        (Function::Tanh, Family::Usual) => one(random.between(-3.0, 3.0)),
        (Function::Tanh, Family::Wide) => {
            let value = random.magnitude(limits.least_exponent, 5.0);
            one(random.signed(value))
        }
        (Function::Tanh | Function::Sinh | Function::Cosh | Function::ExpM1, Family::Hard) => {
            let near = random.between(0.5, 0.6);
            one(random.signed(near))
        }
    }
}
