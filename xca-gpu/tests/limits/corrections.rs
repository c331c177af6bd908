//! Operations on an adapter that does them badly, against the processor's.

use crate::common::TestResult;
use xca_core::prelude::*;
use xca_gpu::{Arithmetic, Gpu, GpuError, GpuOptions, Handicap};

/// The strict engine on an adapter whose divisions and roots are off in the last digits, and which makes only
/// small numbers whole, without the sign of a zero.
fn rough() -> Result<Gpu, GpuError> {
    let handicap = Handicap { rough: true, ..Handicap::default() };
    Gpu::new(&GpuOptions { arithmetic: Arithmetic::Strict, handicap, ..GpuOptions::default() })
}

#[derive(Substates, Clone, Copy)]
struct Numbers {
    a: Real,
    b: Real,
    quotient: Real,
    root: Real,
    quotients: Vector3<Real>,
    direction: Vector3<Real>,
}

#[elementary_process]
fn divide(cell: &mut Cell<Numbers>) {
    cell.quotient = cell.a / cell.b;
    cell.root = cell.a.abs().sqrt();
    cell.quotients = Vector3::new(cell.a, cell.b, 1.0) / cell.a;
    cell.direction = Vector3::new(cell.a, cell.b, 1.0).normalize();
}

#[derive(Substates, Clone, Copy)]
struct Square {
    number: Real,
    root: Real,
}

#[elementary_process]
fn take_root(cell: &mut Cell<Square>) {
    cell.root = cell.number.sqrt();
}

#[derive(Substates, Clone, Copy)]
struct Whole {
    number: Real,
    rounded: [Real; 4],
    fraction: Real,
}

#[elementary_process]
fn round(cell: &mut Cell<Whole>) {
    let number = cell.number;
    cell.rounded = [number.trunc(), number.floor(), number.ceil(), number.round()];
    cell.fraction = number.fract();
}

/// Well mixed bits of a number (splitmix64).
fn mixed(number: u64) -> u64 {
    let mut word = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    word = (word ^ word >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    word = (word ^ word >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ word >> 31
}

/// Operands whose quotient lies near the middle of two floats, near a float, or anywhere.
macro_rules! operands {
    ($name:ident, $type:ident, $bits:ident) => {
        fn $name(number: u64) -> [f64; 2] {
            let bits = |salt: u64| mixed(2 * number + salt) as $bits;
            let [any, other] = [bits(0), bits(1)].map($type::from_bits);
            let near = |bits: $bits| {
                let fraction = (1 << ($type::MANTISSA_DIGITS - 1)) - 1;
                $type::from_bits(bits & fraction | (1.0 as $type).to_bits())
            };
            let [quotient, b] = [near(bits(0)), near(bits(1))];
            let half = $type::EPSILON / 2.0;
            // The smallest numbers, and those whose quotients vanish or are subnormal.
            let tiny = (2.0 as $type).powi($type::MIN_EXP - 3 - (number % 40) as i32);
            let [a, b] = match number % 8 {
                0 | 1 => [any, other],
                2 | 3 => [quotient.mul_add(b, half * b), b],
                4 => [quotient * b, b],
                5 => [quotient * b * tiny, b],
                6 => [quotient.mul_add(b, half * b) * tiny, b],
                _ => [quotient, b * tiny],
            };
            [a.into(), b.into()]
        }
    };
}

operands!(single, f32, u32);
operands!(double, f64, u64);

/// The first cell in which two engines differ, NaN being equal to itself.
fn difference(
    model: &Model,
    engines: [&dyn Engine; 2],
    precision: Precision,
) -> Result<Option<usize>, RunError> {
    let states = engines.map(|engine| -> Result<Vec<Vec<u64>>, RunError> {
        let mut simulation = Simulation::new(model, engine, RunOptions { precision, seed: 0 })?;
        simulation.step()?;
        let snapshot = simulation.snapshot()?;
        let xca_core::GroupSnapshot::Cells(fields) = &snapshot.groups[0] else { return Ok(Vec::new()) };
        Ok(fields.iter().map(|bytes| numbers(bytes, precision)).collect())
    });
    let [wanted, found] = states;
    let (wanted, found) = (wanted?, found?);
    let fields = wanted.iter().zip(&found);
    let cells = model.geometry().cells();
    let first = fields.filter_map(|(wanted, found)| {
        let place = wanted.iter().zip(found).position(|(wanted, found)| wanted != found)?;
        Some(place / (wanted.len() / cells))
    });
    Ok(first.min())
}

/// The bits of floats, with one NaN.
fn numbers(bytes: &[u8], precision: Precision) -> Vec<u64> {
    match precision {
        Precision::F32 => {
            let values = bytes.as_chunks().0.iter().map(|bytes| f32::from_ne_bytes(*bytes));
            values.map(|value| if value.is_nan() { u64::MAX } else { value.to_bits().into() }).collect()
        }
        Precision::F64 => {
            let values = bytes.as_chunks().0.iter().map(|bytes| f64::from_ne_bytes(*bytes));
            values.map(|value| if value.is_nan() { u64::MAX } else { value.to_bits() }).collect()
        }
    }
}

#[test]
fn a_rough_adapter_is_corrected() -> TestResult {
    let corrected = [
        "division in f32",
        "division in f64",
        "square root in f32",
        "square root in f64",
        "rounding to whole numbers in f32",
        "rounding to whole numbers in f64",
    ];
    let told = Handicap { corrected: true, ..Handicap::default() };
    let told = Gpu::new(&GpuOptions { handicap: told, ..GpuOptions::default() })?;
    for gpu in [rough()?, told] {
        assert!(gpu.is_strict());
        assert_eq!(gpu.corrected(), corrected);
    }
    Ok(())
}

#[test]
fn quotients_are_those_of_the_processor() -> TestResult {
    let gpu = rough()?;
    for (precision, operands) in [(Precision::F32, single as fn(u64) -> [f64; 2]), (Precision::F64, double)] {
        let model = Model::builder("quotients")
            .extents([2048, 512, 1])
            .substates::<Numbers>()
            .process(divide)
            .fill(move |site| {
                let [x, y, _] = site.cell();
                let [a, b] = operands((y * 2048 + x) as u64);
                let none = Vector3::splat(0.0);
                Numbers { a, b, quotient: 0.0, root: 0.0, quotients: none, direction: none }
            })
            .build()?;
        let place = difference(&model, [&Reference, &gpu], precision)?;
        assert_eq!(place.map(|cell| operands(cell as u64)), None, "{precision}");
    }
    Ok(())
}

/// All floats of 32 bits from 1 to 4: the square root of every other one is one of these times a power of
/// two.
#[test]
fn all_roots_are_those_of_the_processor() -> TestResult {
    let model = Model::builder("roots")
        .extents([4096, 4096, 1])
        .substates::<Square>()
        .process(take_root)
        .fill(|site| {
            let [x, y, _] = site.cell();
            let bits = 1.0_f32.to_bits() + (y * 4096 + x) as u32;
            Square { number: f32::from_bits(bits).into(), root: 0.0 }
        })
        .build()?;
    assert_eq!(difference(&model, [&Reference, &rough()?], Precision::F32)?, None);
    Ok(())
}

/// Numbers of all sizes up to those that are all whole, of both signs.
#[test]
fn whole_numbers_are_those_of_the_processor() -> TestResult {
    let gpu = rough()?;
    for (precision, digits) in
        [(Precision::F32, f32::MANTISSA_DIGITS), (Precision::F64, f64::MANTISSA_DIGITS)]
    {
        let model = Model::builder("whole numbers")
            .extents([1024, 128, 1])
            .substates::<Whole>()
            .process(round)
            .fill(move |site| {
                let [x, y, _] = site.cell();
                let bits = mixed((y * 1024 + x) as u64);
                let fraction = (bits >> 12) as f64 / 2.0_f64.powi(52);
                let size = (bits % u64::from(digits + 8)) as i32 - 4;
                // Halves and whole numbers among them.
                let fraction = if bits & 0x100 == 0 { fraction } else { (fraction * 8.0).floor() / 8.0 };
                let sign = if bits & 0x200 == 0 { 1.0 } else { -1.0 };
                let number = sign * (1.0 + fraction) * 2.0_f64.powi(size);
                Whole { number, rounded: [0.0; 4], fraction: 0.0 }
            })
            .build()?;
        assert_eq!(difference(&model, [&Reference, &gpu], precision)?, None, "{precision}");
    }
    Ok(())
}
