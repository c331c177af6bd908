//! Reductions: one value out of a whole substate.
//!
//! Rows are reduced one by one, then combined in order. All engines therefore give the same bits, at any
//! number of threads. The items of a row come by cell and label. A row without items has no effect.
//! Floating-point numbers add in `f64`. Integers add in `i64`, and wrap around.
//!
//! NaN is never lost: if any value is NaN, so is the sum, product, minimum or maximum.
//! [`Reduction::CountEqual`] does not count NaN, as it equals no value. Logical reductions treat NaN as true.
//! [`Reduction::CountNonFinite`] counts NaN and infinities.

mod extreme;

use extreme::extreme;
use xca_process::HostValue;
use xca_values::{StoredScalar, StoredType};

/// An operation over all values of a substate, for [`crate::State::reduce`].
///
/// ```
/// use xca_core::prelude::*;
/// use xca_core::reduction::{Reduced, Reduction};
///
/// #[derive(Substates, Clone, Copy)]
/// struct Wind {
///     velocity: Vector2<Real>,
/// }
///
/// let model = Model::builder("wind")
///     .extents([4, 1, 1])
///     .substates::<Wind>()
///     .fill(|site| Wind { velocity: Vector2::new(site.cell()[0] as f64, 0.0) })
///     .build()?;
/// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// let state = simulation.state();
/// let largest = state.reduce(Wind::VELOCITY, &Reduction::Maximum)?;
/// assert_eq!(largest, [Reduced::Float(3.0), Reduced::Float(0.0)]);
/// let moving = state.reduce(Wind::VELOCITY, &Reduction::LogicalOr)?;
/// assert_eq!(moving, [Reduced::Integer(1), Reduced::Integer(0)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// [`crate::State::sum`], [`crate::State::minimum`], [`crate::State::count`] and others return typed values.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Reduction {
    /// The sum.
    Sum,
    /// The product.
    Product,
    /// The smallest value, or NaN if any is NaN.
    Minimum,
    /// The largest value, or NaN if any is NaN.
    Maximum,
    /// The number of values equal to this one, the stored bytes of one component. The two zeros are equal.
    CountEqual(Vec<u8>),
    /// The number of NaN and infinities; 0 for integers.
    CountNonFinite,
    /// 1 if all values are non-zero, else 0.
    LogicalAnd,
    /// 1 if any value is non-zero, else 0.
    LogicalOr,
    /// 1 if an odd number of values are non-zero, else 0.
    LogicalXor,
    /// Bitwise "and" of integers.
    BitAnd,
    /// Bitwise "or" of integers.
    BitOr,
    /// Bitwise "exclusive or" of integers.
    BitXor,
}

/// The result of a reduction, for one component.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Reduced {
    /// There was no value.
    Nothing,
    /// The result for integers, counts and logical reductions.
    Integer(i64),
    /// The result for floating-point numbers.
    Float(f64),
}

impl Reduced {
    /// Combines two results.
    #[inline(always)]
    pub fn combine(self, other: Self, reduction: &Reduction) -> Self {
        match (self, other) {
            (Self::Nothing, result) | (result, Self::Nothing) => result,
            (Self::Integer(a), Self::Integer(b)) => Self::Integer(match reduction {
                Reduction::Sum | Reduction::CountEqual(_) | Reduction::CountNonFinite => a.wrapping_add(b),
                Reduction::Product => a.wrapping_mul(b),
                Reduction::Minimum => a.min(b),
                Reduction::Maximum => a.max(b),
                Reduction::LogicalAnd | Reduction::BitAnd => a & b,
                Reduction::LogicalOr | Reduction::BitOr => a | b,
                Reduction::LogicalXor | Reduction::BitXor => a ^ b,
            }),
            (Self::Float(a), Self::Float(b)) => Self::Float(match reduction {
                Reduction::Product => a * b,
                Reduction::Minimum if b < a || b.is_nan() => b,
                Reduction::Maximum if a < b || b.is_nan() => b,
                Reduction::Minimum | Reduction::Maximum => a,
                _ => a + b,
            }),
            (Self::Integer(a), Self::Float(b)) | (Self::Float(b), Self::Integer(a)) => {
                Self::Float(a as f64 + b)
            }
        }
    }

    /// The result as `f64`; `None` if there was no value.
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Nothing => None,
            Self::Integer(value) => Some(value as f64),
            Self::Float(value) => Some(value),
        }
    }
}

/// Reduces consecutive stored values, component by component.
pub fn reduce_values(reduction: &Reduction, stored: StoredType, values: &[u8]) -> Vec<Reduced> {
    let mut results = Vec::with_capacity(stored.components());
    append_row(reduction, stored, values, &mut results);
    results
}

/// Reduces consecutive stored values, component by component, and appends the results of the components.
pub fn append_row(reduction: &Reduction, stored: StoredType, values: &[u8], results: &mut Vec<Reduced>) {
    let size = stored.scalar.size();
    let first = results.len();
    results.resize(first + stored.components(), Reduced::Nothing);
    if *reduction == Reduction::CountNonFinite && are_finite(stored.scalar, values) {
        let none = if values.is_empty() { Reduced::Nothing } else { Reduced::Integer(0) };
        results[first..].fill(none);
        return;
    }
    if stored.components() == 1
        && let Some(result) = reduce_floats(reduction, stored.scalar, values)
    {
        results[first] = result;
        return;
    }
    for value in values.chunks_exact(stored.size()) {
        for (result, lane) in results[first..].iter_mut().zip(value.chunks_exact(size)) {
            *result = result.combine(one(reduction, stored.scalar, lane), reduction);
        }
    }
}

/// Reduces floating numbers of one lane by a way of their own, where there is one.
fn reduce_floats(reduction: &Reduction, scalar: StoredScalar, values: &[u8]) -> Option<Reduced> {
    let extreme = match (reduction, scalar) {
        (Reduction::Minimum, StoredScalar::F32) => extreme::<f32>(values, |a, b| a < b),
        (Reduction::Minimum, StoredScalar::F64) => extreme::<f64>(values, |a, b| a < b),
        (Reduction::Maximum, StoredScalar::F32) => extreme::<f32>(values, |a, b| a > b),
        (Reduction::Maximum, StoredScalar::F64) => extreme::<f64>(values, |a, b| a > b),
        (Reduction::Sum, StoredScalar::F32) => return Some(sum(StoredScalar::F32, values)),
        (Reduction::Sum, StoredScalar::F64) => return Some(sum(StoredScalar::F64, values)),
        _ => return None,
    };
    Some(extreme.map_or(Reduced::Nothing, Reduced::Float))
}

/// Adds up numbers of one lane, in order. What is done is known to the compiler, so that no choice is left in
/// the loop.
#[inline(always)]
fn sum(scalar: StoredScalar, values: &[u8]) -> Reduced {
    let lanes = values.chunks_exact(scalar.size()).map(|lane| number(scalar, lane));
    lanes.fold(Reduced::Nothing, |all, one| all.combine(one, &Reduction::Sum))
}

/// The results of all rows, one row after the other.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ReducedRows {
    /// The number of results in a row, one for each component.
    pub components: usize,
    /// The results. Those of a row without items are [`Reduced::Nothing`].
    pub results: Vec<Reduced>,
}

impl ReducedRows {
    /// Combines the rows in order: one result for each component.
    pub fn combined(&self, reduction: &Reduction) -> Vec<Reduced> {
        let mut results = vec![Reduced::Nothing; self.components];
        for row in self.results.chunks_exact(self.components.max(1)) {
            for (result, part) in results.iter_mut().zip(row) {
                *result = result.combine(*part, reduction);
            }
        }
        results
    }
}

/// Whether all numbers are finite, which they nearly always are: a loop over bits, for vector instructions.
/// The exponent has all its bits in NaN and infinities alone.
fn are_finite(scalar: StoredScalar, values: &[u8]) -> bool {
    const SINGLE: u32 = f32::INFINITY.to_bits();
    const DOUBLE: u64 = f64::INFINITY.to_bits();
    match scalar {
        StoredScalar::F32 => {
            let numbers = values.chunks_exact(4).map(bytemuck::pod_read_unaligned::<u32>);
            !numbers.fold(false, |found, bits| found | (bits & SINGLE == SINGLE))
        }
        StoredScalar::F64 => {
            let numbers = values.chunks_exact(8).map(bytemuck::pod_read_unaligned::<u64>);
            !numbers.fold(false, |found, bits| found | (bits & DOUBLE == DOUBLE))
        }
        StoredScalar::U8 | StoredScalar::I32 | StoredScalar::U32 => true,
    }
}

/// What a lane adds to a result.
#[inline(always)]
fn one(reduction: &Reduction, scalar: StoredScalar, bytes: &[u8]) -> Reduced {
    let number = number(scalar, bytes);
    match reduction {
        Reduction::CountEqual(wanted) => Reduced::Integer(i64::from(number == self::number(scalar, wanted))),
        Reduction::CountNonFinite => {
            Reduced::Integer(i64::from(number.number().is_some_and(|number| !number.is_finite())))
        }
        Reduction::LogicalAnd | Reduction::LogicalOr | Reduction::LogicalXor => {
            Reduced::Integer(i64::from(number.number() != Some(0.0)))
        }
        _ => number,
    }
}

/// The number that a lane stores.
#[inline(always)]
fn number(scalar: StoredScalar, bytes: &[u8]) -> Reduced {
    match scalar {
        StoredScalar::U8 => Reduced::Integer(i64::from(bytes[0])),
        StoredScalar::I32 => Reduced::Integer(i64::from(bytemuck::pod_read_unaligned::<i32>(bytes))),
        StoredScalar::U32 => Reduced::Integer(i64::from(bytemuck::pod_read_unaligned::<u32>(bytes))),
        StoredScalar::F32 => Reduced::Float(f64::from(bytemuck::pod_read_unaligned::<f32>(bytes))),
        StoredScalar::F64 => Reduced::Float(bytemuck::pod_read_unaligned(bytes)),
    }
}

/// A value whose components can be reduced to values of the same shape.
#[diagnostic::on_unimplemented(
    message = "values of `{Self}` have no sum, product, minimum or maximum",
    label = "not a substate of numbers",
    note = "count the cells or items in a state: `state.count(substate, value)`"
)]
pub trait Reducible: HostValue {
    /// The type of a sum: `i64` for integers and `bool`, `f64` for floating numbers, or a vector or an array
    /// of these.
    type Sum;

    /// The sum or product from the results of the components. `of_nothing` is the result without values: 0 or
    /// 1.
    fn total(results: &[Reduced], of_nothing: u8) -> Self::Sum;

    /// The contribution of a component to a sum.
    fn reduced(&self, component: usize) -> Reduced;

    /// A value of the same type from the results of the components; `None` if there was no value.
    fn same(results: &[Reduced]) -> Option<Self>;
}

macro_rules! reducible {
    ($($type:ident => $variant:ident($sum:ident)),*) => {$(
        impl Reducible for $type {
            type Sum = $sum;

            fn total(results: &[Reduced], of_nothing: u8) -> $sum {
                match results[0] {
                    Reduced::Nothing => $sum::from(of_nothing),
                    Reduced::Integer(value) => value as $sum,
                    Reduced::Float(value) => value as $sum,
                }
            }

            fn reduced(&self, _lane: usize) -> Reduced {
                Reduced::$variant((*self).into())
            }

            fn same(results: &[Reduced]) -> Option<Self> {
                match results[0] {
                    Reduced::Nothing => None,
                    Reduced::Integer(value) => Some(value as $type),
                    Reduced::Float(value) => Some(value as $type),
                }
            }
        }
    )*};
}

reducible!(u8 => Integer(i64), i32 => Integer(i64), u32 => Integer(i64), f32 => Float(f64), f64 => Float(f64));

/// The sum is the number of `true`. The product and the minimum are "and", the maximum is "or".
impl Reducible for bool {
    type Sum = i64;

    fn total(results: &[Reduced], of_nothing: u8) -> i64 {
        u8::total(results, of_nothing)
    }

    fn reduced(&self, _component: usize) -> Reduced {
        Reduced::Integer(i64::from(*self))
    }

    fn same(results: &[Reduced]) -> Option<bool> {
        u8::same(results).map(|value| value != 0)
    }
}

impl<T: Reducible, const N: usize> Reducible for [T; N] {
    type Sum = [T::Sum; N];

    fn total(results: &[Reduced], of_nothing: u8) -> Self::Sum {
        std::array::from_fn(|element| T::total(&results[element * T::COMPONENTS..], of_nothing))
    }

    fn reduced(&self, component: usize) -> Reduced {
        self[component / T::COMPONENTS].reduced(component % T::COMPONENTS)
    }

    fn same(results: &[Reduced]) -> Option<Self> {
        let elements = results.chunks(T::COMPONENTS).map(T::same).collect::<Option<Vec<T>>>()?;
        elements.try_into().ok()
    }
}

macro_rules! reducible_vector {
    ($($vector:ident { $($index:literal),+ }),*) => {$(
        impl<T> Reducible for xca_values::$vector<T>
        where
            T: Reducible<Scalar = T> + xca_process::HostScalar,
        {
            type Sum = xca_values::$vector<T::Sum>;

            fn total(results: &[Reduced], of_nothing: u8) -> Self::Sum {
                xca_values::$vector::new($(T::total(&results[$index..], of_nothing)),+)
            }

            fn reduced(&self, component: usize) -> Reduced {
                HostValue::component(self, component).reduced(0)
            }

            fn same(results: &[Reduced]) -> Option<Self> {
                Some(xca_values::$vector::new($(T::same(&results[$index..])?),+))
            }
        }
    )*};
}

reducible_vector!(Vector2 { 0, 1 }, Vector3 { 0, 1, 2 }, Vector4 { 0, 1, 2, 3 });

#[cfg(test)]
mod tests {
    use super::{Reduced, Reduction, reduce_values};
    use xca_values::{StoredScalar, StoredType};

    #[test]
    fn each_reduction_by_hand() {
        let stored = StoredType { scalar: StoredScalar::I32, lanes: 1, length: 1 };
        let values: Vec<u8> = [6_i32, -3, 0, 6].iter().flat_map(|value| value.to_ne_bytes()).collect();
        let reduce = |reduction: Reduction| reduce_values(&reduction, stored, &values)[0];
        assert_eq!(reduce(Reduction::Sum), Reduced::Integer(9));
        assert_eq!(reduce(Reduction::Product), Reduced::Integer(0));
        assert_eq!(reduce(Reduction::Minimum), Reduced::Integer(-3));
        assert_eq!(reduce(Reduction::Maximum), Reduced::Integer(6));
        assert_eq!(reduce(Reduction::CountEqual(6_i32.to_ne_bytes().to_vec())), Reduced::Integer(2));
        assert_eq!(reduce(Reduction::CountNonFinite), Reduced::Integer(0));
        assert_eq!(reduce(Reduction::LogicalAnd), Reduced::Integer(0));
        assert_eq!(reduce(Reduction::LogicalOr), Reduced::Integer(1));
        assert_eq!(reduce(Reduction::LogicalXor), Reduced::Integer(1));
        assert_eq!(reduce(Reduction::BitAnd), Reduced::Integer(0));
        assert_eq!(reduce(Reduction::BitOr), Reduced::Integer(6 | -3));
        assert_eq!(reduce(Reduction::BitXor), Reduced::Integer(-3));
        assert_eq!(reduce_values(&Reduction::Sum, stored, &[]), [Reduced::Nothing]);
    }

    #[test]
    fn lanes_are_apart() {
        let stored = StoredType { scalar: StoredScalar::F32, lanes: 2, length: 1 };
        let values: Vec<u8> =
            [1.0_f32, 10.0, 2.0, 20.0].iter().flat_map(|value| value.to_ne_bytes()).collect();
        assert_eq!(
            reduce_values(&Reduction::Sum, stored, &values),
            [Reduced::Float(3.0), Reduced::Float(30.0)]
        );
    }

    #[test]
    fn nan_and_zeros() {
        let stored = StoredType { scalar: StoredScalar::F64, lanes: 1, length: 1 };
        let values: Vec<u8> =
            [f64::NAN, 0.0, -0.0, 3.0].iter().flat_map(|value| value.to_ne_bytes()).collect();
        let reduce = |reduction: Reduction| reduce_values(&reduction, stored, &values)[0];
        for reduction in [Reduction::Sum, Reduction::Product, Reduction::Minimum, Reduction::Maximum] {
            assert!(reduce(reduction.clone()).number().is_some_and(f64::is_nan), "{reduction:?}");
        }
        assert_eq!(reduce(Reduction::LogicalXor), Reduced::Integer(0));
        assert_eq!(reduce(Reduction::CountNonFinite), Reduced::Integer(1));
        assert_eq!(reduce(Reduction::CountEqual(0.0_f64.to_ne_bytes().to_vec())), Reduced::Integer(2));
    }
}
