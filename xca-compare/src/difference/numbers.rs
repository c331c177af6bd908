//! Stored bytes, compared in pairs of numbers.

use xca_core::{StoredScalar, StoredType};

/// The scalars of a substate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Numbers<'a> {
    stored: StoredType,
    bytes: &'a [u8],
}

/// Two scalars to compare.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub(super) first: f64,
    pub(super) other: f64,
    /// Whether the bits are equal, in the lower of their precisions.
    pub(super) is_identical: bool,
    /// The distance in representable values.
    pub(super) ulp: u64,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(stored: StoredType, bytes: &'a [u8]) -> Self {
        Self { stored, bytes }
    }

    pub(super) fn components(&self) -> usize {
        self.stored.components()
    }

    pub(super) fn is_float(&self) -> bool {
        matches!(self.stored.scalar, StoredScalar::F32 | StoredScalar::F64)
    }

    fn at<const N: usize>(&self, index: usize) -> [u8; N] {
        let mut bytes = [0; N];
        bytes.copy_from_slice(&self.bytes[index * N..(index + 1) * N]);
        bytes
    }

    /// The scalar with this index. Each type fits into `f64`.
    fn number(&self, index: usize) -> f64 {
        match self.stored.scalar {
            StoredScalar::U8 => self.bytes[index].into(),
            StoredScalar::I32 => i32::from_ne_bytes(self.at(index)).into(),
            StoredScalar::U32 => u32::from_ne_bytes(self.at(index)).into(),
            StoredScalar::F32 => f32::from_ne_bytes(self.at(index)).into(),
            StoredScalar::F64 => f64::from_ne_bytes(self.at(index)),
        }
    }

    fn bits(&self, index: usize) -> u64 {
        match self.stored.scalar {
            StoredScalar::U8 => self.bytes[index].into(),
            StoredScalar::I32 | StoredScalar::U32 | StoredScalar::F32 => {
                u32::from_ne_bytes(self.at(index)).into()
            }
            StoredScalar::F64 => u64::from_ne_bytes(self.at(index)),
        }
    }

    /// A scalar of `self` and one of `others`.
    pub(super) fn pair(&self, index: usize, others: &Self, other: usize) -> Pair {
        let (a, b) = (self.number(index), others.number(other));
        let same_type = self.stored.scalar == others.stored.scalar;
        if same_type && self.bits(index) == others.bits(other) {
            return Pair { first: a, other: b, is_identical: true, ulp: 0 };
        }
        let is_single = |numbers: &Self| numbers.stored.scalar == StoredScalar::F32;
        if is_single(self) || is_single(others) {
            let (a, b) = (a as f32, b as f32);
            let is_identical = !same_type && a.to_bits() == b.to_bits();
            let ulp = ordered_32(a).abs_diff(ordered_32(b)).into();
            return Pair { first: a.into(), other: b.into(), is_identical, ulp };
        }
        Pair { first: a, other: b, is_identical: false, ulp: ordered_64(a).abs_diff(ordered_64(b)) }
    }
}

impl Pair {
    fn are_same_value(&self) -> bool {
        // 0 equals -0, and NaN equals NaN.
        self.first == self.other || (self.first.is_nan() && self.other.is_nan())
    }

    pub(super) fn absolute(&self) -> f64 {
        let difference = (self.first - self.other).abs();
        match self.are_same_value() {
            true => 0.0,
            false if difference.is_nan() => f64::INFINITY,
            false => difference,
        }
    }

    pub(super) fn relative(&self) -> f64 {
        let absolute = self.absolute();
        let larger = self.first.abs().max(self.other.abs());
        if absolute == 0.0 || absolute.is_infinite() { absolute } else { absolute / larger }
    }
}

/// Maps floats to integers of the same order, without gaps. Both zeros become 0.
fn ordered_64(value: f64) -> i64 {
    let bits = value.to_bits() as i64;
    if bits < 0 { i64::MIN.wrapping_sub(bits) } else { bits }
}

fn ordered_32(value: f32) -> i32 {
    let bits = value.to_bits() as i32;
    if bits < 0 { i32::MIN.wrapping_sub(bits) } else { bits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_apart() {
        for value in [1.0, -1.0, 0.0, -0.0, 5e-324, -5e-324, f64::MAX, 3.5e-200] {
            assert_eq!(ordered_64(value.next_up()) - ordered_64(value), 1, "{value}");
        }
        for value in [1.0_f32, -1.0, -0.0, 1e-45, f32::MAX] {
            assert_eq!(ordered_32(value.next_up()) - ordered_32(value), 1, "{value}");
        }
        assert_eq!(ordered_64(-0.0), ordered_64(0.0));
        assert_eq!(ordered_64(-1.0).abs_diff(ordered_64(1.0)), 2 * 1.0_f64.to_bits());
        assert!(ordered_64(f64::INFINITY).abs_diff(ordered_64(f64::NEG_INFINITY)) > 1 << 63);
    }

    #[test]
    fn what_is_no_number_differs_from_every_number() {
        let pair = |first: f64, other: f64| Pair { first, other, is_identical: false, ulp: 0 };
        assert_eq!(pair(f64::NAN, 1.0).absolute(), f64::INFINITY);
        assert_eq!(pair(f64::NAN, f64::INFINITY).relative(), f64::INFINITY);
        assert_eq!(pair(f64::NAN, -f64::NAN).absolute(), 0.0);
        assert_eq!(pair(0.0, -0.0).relative(), 0.0);
        assert_eq!(pair(2.0, 1.0).relative(), 0.5);
        assert_eq!(pair(-2.0, 2.0).relative(), 2.0);
    }
}
