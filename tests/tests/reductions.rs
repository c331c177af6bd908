//! Reductions of every kind over cells and items against a computation that knows nothing of engines.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::reduction::{Reduced, Reduction};
use xca_core::{HostValue, StateError};
use xca_tests::suite::engines::{self, PRECISIONS};
use xca_tests::suite::lattice::mix;

/// Each type of substate. Floating numbers are multiples of a small power of two, so that their exact sum can
/// be computed.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ledger {
    byte: u8,
    signed: i32,
    odd: u32,
    single: f32,
    double: f64,
    real: Real,
    pair: Vector2<i32>,
    trio: Vector3<Real>,
}

/// The same for items.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Entry {
    byte: u8,
    signed: i32,
    odd: u32,
    double: f64,
    quad: Vector4<f32>,
}

const EXTENTS: [usize; 3] = [37, 11, 5];
/// Enough for a few in most cells; none are in the rows of every third y.
const ITEMS: usize = 9426;
/// What the floating numbers are multiples of.
const GRAIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// A number of either sign with at most 20 bits, exact in `f32`.
fn short(salt: u32, number: u32) -> f64 {
    (f64::from(mix(salt, number) >> 12) - 524_288.0) / 1024.0
}

/// A number of either sign with at most 50 bits.
fn long(salt: u32, number: u32) -> f64 {
    let bits = u64::from(mix(salt, number)) << 18 | u64::from(mix(salt, number + 100) & 0x3_FFFF);
    (bits as f64 - (1_u64 << 49) as f64) * GRAIN
}

fn ledger(site: Site) -> Ledger {
    let [x, y, z] = site.cell();
    let salt = mix(mix(x as u32, y as u32), z as u32);
    Ledger {
        byte: (salt % 7) as u8,
        signed: mix(salt, 1) as i32 | 1,
        odd: mix(salt, 2) | 1,
        single: short(salt, 3) as f32,
        double: long(salt, 4),
        real: short(salt, 5),
        pair: Vector2::new(mix(salt, 6) as i32, -(mix(salt, 7) as i32 >> 1).abs() - 1),
        trio: Vector3::new(short(salt, 8), short(salt, 9), -1.0),
    }
}

fn entry(label: u32) -> Item<Entry> {
    let salt = mix(label, 77);
    let state = Entry {
        byte: (salt % 3) as u8,
        signed: mix(salt, 1) as i32,
        odd: mix(salt, 2) | 1,
        double: long(salt, 3),
        quad: Vector4::new(short(salt, 4) as f32, short(salt, 5) as f32, 2.0, -0.5),
    };
    Item {
        label,
        cell: [
            mix(salt, 9) as usize % 37,
            mix(salt, 10) as usize % 11 / 3 * 3 + mix(salt, 10) as usize % 11 % 3 % 2,
            mix(salt, 11) as usize % 5,
        ],
        state,
    }
}

fn model() -> Result<Model, ModelError> {
    Model::builder("ledger")
        .extents(EXTENTS)
        .substates::<Ledger>()
        .population::<Entry>(100)
        .fill(ledger)
        .initialise(|state| Ok(state.set_items((0..ITEMS as u32).map(entry).collect())?))
        .build()
}

/// Runs a check on every engine in both precisions.
fn everywhere(check: impl Fn(&State<'_>) -> Result<(), StateError>) -> Result<(), Box<dyn Error>> {
    let model = model()?;
    for engine in engines::all()? {
        for precision in PRECISIONS {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed: 0 })?;
            check(&simulation.state())?;
        }
    }
    Ok(())
}

fn lane<V: HostValue>(values: &[V], lane: usize) -> Vec<V::Scalar> {
    values.iter().map(|value| value.component(lane)).collect()
}

/// All reductions of integers, by arithmetic in 128 bits and by counting.
fn check_integers<S: Substates, V: HostValue>(
    state: &State<'_>,
    substate: Substate<S, V>,
) -> Result<(), StateError>
where
    V::Scalar: Into<i64>,
{
    let values = state.read(substate)?;
    for number in 0..V::COMPONENTS {
        let values: Vec<i64> = lane(&values, number).into_iter().map(Into::into).collect();
        let result = |reduction| Ok::<_, StateError>(state.reduce(substate, &reduction)?[number]);
        let sum: i128 = values.iter().map(|value| i128::from(*value)).sum();
        assert_eq!(result(Reduction::Sum)?, Reduced::Integer(sum as i64), "{substate:?}");
        // Modulo 2^64, kept apart from the sign.
        let product = values.iter().fold(1_u64, |product, value| product.wrapping_mul(*value as u64));
        assert_eq!(result(Reduction::Product)?, Reduced::Integer(product as i64), "{substate:?}");
        let extreme = |largest: bool| {
            let mut sorted = values.clone();
            sorted.sort_unstable();
            Reduced::Integer(if largest { sorted[sorted.len() - 1] } else { sorted[0] })
        };
        assert_eq!(result(Reduction::Minimum)?, extreme(false), "{substate:?}");
        assert_eq!(result(Reduction::Maximum)?, extreme(true), "{substate:?}");
        let zeros = values.iter().filter(|value| **value == 0).count();
        let others = values.len() - zeros;
        let logical = |truth: bool| Reduced::Integer(i64::from(truth));
        assert_eq!(result(Reduction::LogicalAnd)?, logical(zeros == 0), "{substate:?}");
        assert_eq!(result(Reduction::LogicalOr)?, logical(others > 0), "{substate:?}");
        assert_eq!(result(Reduction::LogicalXor)?, logical(others % 2 == 1), "{substate:?}");
        let bits = |keep: &dyn Fn(usize) -> bool| {
            (0..64).fold(0_i64, |result, bit| {
                let ones = values.iter().filter(|value| **value >> bit & 1 == 1).count();
                result | i64::from(keep(ones)) << bit
            })
        };
        assert_eq!(
            result(Reduction::BitAnd)?,
            Reduced::Integer(bits(&|ones| ones == values.len())),
            "{substate:?}"
        );
        assert_eq!(result(Reduction::BitOr)?, Reduced::Integer(bits(&|ones| ones > 0)), "{substate:?}");
        assert_eq!(result(Reduction::BitXor)?, Reduced::Integer(bits(&|ones| ones % 2 == 1)), "{substate:?}");
    }
    Ok(())
}

/// How many values each row has.
fn of_cells(_: &State<'_>) -> Result<Vec<usize>, StateError> {
    Ok(vec![EXTENTS[0]; EXTENTS[1] * EXTENTS[2]])
}

fn of_items(state: &State<'_>) -> Result<Vec<usize>, StateError> {
    let mut rows = vec![0; EXTENTS[1] * EXTENTS[2]];
    for item in state.items::<Entry>()? {
        rows[item.cell[2] * EXTENTS[1] + item.cell[1]] += 1;
    }
    assert!(rows.contains(&0) && rows.iter().any(|items| *items > 50));
    Ok(rows)
}

/// The sum is near the exact one, and its bits are those of the documented order: within each row from the
/// first to the last, then the rows from the first to the last.
fn check_floats<S: Substates, V: HostValue>(
    state: &State<'_>,
    substate: Substate<S, V>,
    rows: &[usize],
) -> Result<(), StateError>
where
    V::Scalar: Into<f64>,
{
    let values = state.read(substate)?;
    for number in 0..V::COMPONENTS {
        let values: Vec<f64> = lane(&values, number).into_iter().map(Into::into).collect();
        let result = |reduction| {
            let result = state.reduce(substate, &reduction)?[number];
            Ok::<f64, StateError>(if let Reduced::Float(value) = result { value } else { f64::NAN })
        };
        let exact: i128 = values.iter().map(|value| (value / GRAIN) as i128).sum();
        let magnitude: f64 = values.iter().map(|value| value.abs()).sum();
        let sum = result(Reduction::Sum)?;
        let error = (sum - exact as f64 * GRAIN).abs();
        assert!(
            error <= magnitude * f64::EPSILON * values.len() as f64,
            "{substate:?}: {sum} is off by {error}"
        );
        let in_order = |combine: &dyn Fn(f64, f64) -> f64| {
            let mut rest = values.as_slice();
            let parts = rows.iter().map(|length| {
                let (row, others) = rest.split_at(*length);
                rest = others;
                row.iter().copied().reduce(combine)
            });
            parts.flatten().reduce(combine).map(f64::to_bits)
        };
        assert_eq!(Some(sum.to_bits()), in_order(&|a, b| a + b), "{substate:?}");
        assert_eq!(Some(result(Reduction::Product)?.to_bits()), in_order(&|a, b| a * b), "{substate:?}");
        let (mut smallest, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        for &value in &values {
            smallest = if value < smallest { value } else { smallest };
            largest = if value > largest { value } else { largest };
        }
        assert_eq!(result(Reduction::Minimum)?, smallest, "{substate:?}");
        assert_eq!(result(Reduction::Maximum)?, largest, "{substate:?}");
        let others = values.iter().filter(|value| **value != 0.0).count();
        let logical = |reduction| Ok::<_, StateError>(state.reduce(substate, &reduction)?[number]);
        let truth = |truth: bool| Reduced::Integer(i64::from(truth));
        assert_eq!(logical(Reduction::LogicalAnd)?, truth(others == values.len()), "{substate:?}");
        assert_eq!(logical(Reduction::LogicalOr)?, truth(others > 0), "{substate:?}");
        assert_eq!(logical(Reduction::LogicalXor)?, truth(others % 2 == 1), "{substate:?}");
    }
    Ok(())
}

#[test]
fn integers() -> Result<(), Box<dyn Error>> {
    everywhere(|state| {
        check_integers(state, Ledger::BYTE)?;
        check_integers(state, Ledger::SIGNED)?;
        check_integers(state, Ledger::ODD)?;
        check_integers(state, Ledger::PAIR)?;
        check_integers(state, Entry::BYTE)?;
        check_integers(state, Entry::SIGNED)?;
        check_integers(state, Entry::ODD)
    })
}

#[test]
fn floats() -> Result<(), Box<dyn Error>> {
    everywhere(|state| {
        let (cells, items) = (of_cells(state)?, of_items(state)?);
        check_floats(state, Ledger::SINGLE, &cells)?;
        check_floats(state, Ledger::DOUBLE, &cells)?;
        check_floats(state, Ledger::REAL, &cells)?;
        check_floats(state, Ledger::TRIO, &cells)?;
        check_floats(state, Entry::DOUBLE, &items)?;
        check_floats(state, Entry::QUAD, &items)
    })
}

/// The order of the sum shows: another one gives other bits. Else the test above would test nothing.
#[test]
fn the_order_of_a_sum_shows() -> Result<(), Box<dyn Error>> {
    everywhere(|state| {
        let forwards: f64 = state.read(Entry::DOUBLE)?.iter().sum();
        assert_ne!(state.sum(Entry::DOUBLE)?.to_bits(), forwards.to_bits());
        let forwards: f64 = state.read(Ledger::DOUBLE)?.iter().sum();
        assert_ne!(state.sum(Ledger::DOUBLE)?.to_bits(), forwards.to_bits());
        Ok(())
    })
}

#[test]
fn the_short_ways() -> Result<(), Box<dyn Error>> {
    everywhere(|state| {
        let bytes = state.read(Ledger::BYTE)?;
        assert_eq!(state.sum(Ledger::BYTE)?, bytes.iter().map(|byte| i64::from(*byte)).sum::<i64>());
        assert_eq!(state.count(Ledger::BYTE, 3)?, bytes.iter().filter(|byte| **byte == 3).count() as u64);
        assert_eq!(state.count(Ledger::BYTE, 200)?, 0);
        let value = state.read(Ledger::REAL)?[5];
        let same = state.read(Ledger::REAL)?.iter().filter(|other| **other == value).count() as u64;
        assert_eq!(state.count(Ledger::REAL, value)?, same);
        let entries = state.read(Entry::SIGNED)?;
        assert_eq!(state.minimum(Entry::SIGNED)?, entries.iter().copied().min());
        assert_eq!(state.maximum(Entry::SIGNED)?, entries.iter().copied().max());
        assert!(state.minimum(Entry::SIGNED)?.is_some_and(|smallest| smallest < 0));
        let pairs = state.read(Ledger::PAIR)?;
        let sum =
            |lane: fn(&Vector2<i32>) -> i32| pairs.iter().map(|pair| i64::from(lane(pair))).sum::<i64>();
        assert_eq!(state.sum(Ledger::PAIR)?, Vector2::new(sum(|pair| pair.x), sum(|pair| pair.y)));
        assert_eq!(state.maximum(Ledger::PAIR)?.map(|pair| pair.y), pairs.iter().map(|pair| pair.y).max());
        assert_eq!(state.minimum(Ledger::TRIO)?.map(|trio| trio.z), Some(-1.0));
        let product =
            state.read(Ledger::ODD)?.iter().fold(1_i64, |product, odd| product.wrapping_mul(i64::from(*odd)));
        assert_eq!(state.product(Ledger::ODD)?, product);
        assert_ne!(product, 0);
        Ok(())
    })
}

/// What is computed from several substates is reduced as a substate is: the same bits on every engine.
#[test]
fn expressions() -> Result<(), Box<dyn Error>> {
    let first: std::cell::Cell<Option<[u64; 2]>> = std::cell::Cell::new(None);
    everywhere(|state| {
        // The sum of a substate is that of the expression which names it, to the last bit.
        let double = state.sum_of(|ledger: &Ledger| ledger.double)?;
        assert_eq!(double.to_bits(), state.sum(Ledger::DOUBLE)?.to_bits());
        let double = state.sum_of(|entry: &Entry| entry.double)?;
        assert_eq!(double.to_bits(), state.sum(Entry::DOUBLE)?.to_bits());
        assert_eq!(state.sum_of(|ledger: &Ledger| ledger.pair)?, state.sum(Ledger::PAIR)?);
        assert_eq!(state.sum_of(|entry: &Entry| entry.quad)?, state.sum(Entry::QUAD)?);
        let count = state.count_where(|ledger: &Ledger| ledger.byte == 3)?;
        assert_eq!(count, state.count(Ledger::BYTE, 3)?);
        let both = state.count_where(|entry: &Entry| entry.byte == 1 && entry.signed > 0)?;
        let items = state.items::<Entry>()?;
        let wanted = items.iter().filter(|item| item.state.byte == 1 && item.state.signed > 0).count();
        assert_eq!(both, wanted as u64);
        let mixed = [
            state.sum_of(|ledger: &Ledger| ledger.double * f64::from(ledger.single))?,
            state.sum_of(|entry: &Entry| entry.double * f64::from(entry.quad.x))?,
        ];
        let mixed = mixed.map(f64::to_bits);
        assert_eq!(first.replace(Some(mixed)).unwrap_or(mixed), mixed);
        Ok(())
    })
}

#[test]
fn expressions_of_nothing() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("empty").extents([3, 3, 3]).population::<Entry>(1).build()?;
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    let state = simulation.state();
    assert_eq!(state.sum_of(|entry: &Entry| entry.double)?, 0.0);
    assert_eq!(state.count_where(|_: &Entry| true)?, 0);
    let error = state.count_where(|_: &Ledger| true);
    assert_eq!(error, Err(StateError::UnknownSubstates("Ledger")));
    Ok(())
}

/// One NaN makes a sum, product, minimum and maximum NaN, wherever it stands, and counts as nothing; both
/// zeros are zero.
#[test]
fn no_numbers_and_zeros() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("holes").extents([3, 5, 2]).substates::<Ledger>().fill(ledger).build()?;
    for engine in engines::all()? {
        for precision in PRECISIONS {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed: 0 })?;
            let mut state = simulation.state();
            for empty in [0, 1, 14, 29] {
                let mut values = vec![-0.0; 30];
                values[empty] = f64::NAN;
                state.write(Ledger::REAL, &values)?;
                assert!(state.minimum(Ledger::REAL)?.is_some_and(f64::is_nan));
                assert!(state.maximum(Ledger::REAL)?.is_some_and(f64::is_nan));
                assert!(state.sum(Ledger::REAL)?.is_nan());
                assert!(state.product(Ledger::REAL)?.is_nan());
                assert_eq!(state.count(Ledger::REAL, 0.0)?, 29);
                assert_eq!(state.count(Ledger::REAL, f64::NAN)?, 0);
                assert_eq!(state.reduce(Ledger::REAL, &Reduction::LogicalXor)?, [Reduced::Integer(1)]);
                assert_eq!(state.reduce(Ledger::REAL, &Reduction::LogicalAnd)?, [Reduced::Integer(0)]);
            }
            state.write(Ledger::REAL, &[f64::INFINITY; 30])?;
            assert_eq!(state.minimum(Ledger::REAL)?, Some(f64::INFINITY));
            for reduction in [Reduction::BitAnd, Reduction::BitOr, Reduction::BitXor] {
                assert_eq!(state.reduce(Ledger::TRIO, &reduction), Err(StateError::BitsOfFloats("trio")));
            }
        }
    }
    Ok(())
}

/// Nothing comes of nothing, but a sum of 0 and a product of 1.
#[test]
fn an_empty_population() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("empty").extents([3, 3, 3]).population::<Entry>(1).build()?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        let state = simulation.state();
        assert_eq!(state.reduce(Entry::QUAD, &Reduction::Maximum)?, [Reduced::Nothing; 4]);
        assert_eq!(state.sum(Entry::SIGNED)?, 0);
        assert_eq!(state.product(Entry::SIGNED)?, 1);
        assert_eq!(state.product(Entry::QUAD)?, Vector4::splat(1.0));
        assert_eq!(state.minimum(Entry::DOUBLE)?, None);
        assert_eq!(state.maximum(Entry::QUAD)?, None);
        assert_eq!(state.count(Entry::BYTE, 0)?, 0);
    }
    Ok(())
}
