//! Ranges of integers.

use crate::types::Type;
use xca_core::ScalarType;

/// All numbers from the least to the most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Range {
    pub(super) least: i64,
    pub(super) most: i64,
}

impl Range {
    pub(super) const fn new(least: i64, most: i64) -> Self {
        Self { least, most }
    }

    pub(super) const fn only(number: i64) -> Self {
        Self::new(number, number)
    }

    /// Every number of a type; of vectors, of their lanes.
    pub(super) fn of_type(type_: &Type) -> Self {
        match type_ {
            Type::Bool => Self::new(0, 1),
            Type::State(names) => Self::new(0, names.largest().into()),
            _ => match type_.scalar() {
                Some(ScalarType::U8) => Self::new(0, u8::MAX.into()),
                Some(ScalarType::I32) => Self::new(i32::MIN.into(), i32::MAX.into()),
                _ => Self::new(0, u32::MAX.into()),
            },
        }
    }

    fn contains(self, number: i64) -> bool {
        (self.least..=self.most).contains(&number)
    }

    pub(super) fn lies_within(self, outer: Self) -> bool {
        outer.least <= self.least && self.most <= outer.most
    }

    pub(super) fn with(self, other: Self) -> Self {
        Self::new(self.least.min(other.least), self.most.max(other.most))
    }

    /// The least and the most of what an operation gives for the ends.
    pub(super) fn ends(self, other: Self, operation: impl Fn(i64, i64) -> i64) -> Self {
        let [a, b, c, d] = [
            operation(self.least, other.least),
            operation(self.least, other.most),
            operation(self.most, other.least),
            operation(self.most, other.most),
        ];
        Self::new(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }

    pub(super) fn may_be_zero(self) -> bool {
        self.contains(0)
    }

    /// Whether a division by these numbers may have no result.
    pub(super) fn may_stop_division_of(self, dividend: Self, type_: &Type) -> bool {
        let signed = type_.scalar() == Some(ScalarType::I32);
        self.contains(0) || signed && self.contains(-1) && dividend.contains(i32::MIN.into())
    }

    /// The remainder keeps the sign of the dividend, and is nearer to zero than the divisor and no further
    /// than the dividend.
    pub(super) fn remainder(self, divisor: Self) -> Self {
        let largest = divisor.least.abs().max(divisor.most.abs()) - 1;
        Self::new(self.least.max(-largest).min(0), self.most.min(largest).max(0))
    }

    /// The variable of a range up to these numbers.
    pub(super) fn counted(self, to: Self, inclusive: bool) -> Self {
        Self::new(self.least, to.most - i64::from(!inclusive))
    }
}

#[cfg(test)]
mod tests {
    use super::Range;
    use crate::types::Type;
    use xca_core::ScalarType;

    /// Against all numbers of small ranges.
    #[test]
    fn operations_hold_all_results() {
        let ends = [-4_i64, -2, -1, 0, 1, 3, 5];
        let ranges: Vec<Range> = ends
            .iter()
            .flat_map(|a| ends.iter().filter(move |b| a <= b).map(move |b| Range::new(*a, *b)))
            .collect();
        for a in &ranges {
            for b in &ranges {
                for x in a.least..=a.most {
                    for y in b.least..=b.most {
                        assert!(a.ends(*b, |a, b| a + b).contains(x + y));
                        assert!(a.ends(*b, |a, b| a - b).contains(x - y));
                        assert!(a.ends(*b, |a, b| a * b).contains(x * y), "{a:?} {b:?} {x} {y}");
                        if b.least > 0 {
                            assert!(a.ends(*b, |a, b| a / b).contains(x / y), "{a:?} {b:?} {x} {y}");
                        }
                        if y != 0 {
                            assert!(a.remainder(*b).contains(x % y), "{a:?} {b:?} {x} {y}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn divisions_that_may_have_no_result() {
        let signed = Type::Scalar(ScalarType::I32);
        let all = Range::of_type(&signed);
        assert!(Range::new(0, 3).may_stop_division_of(Range::only(1), &signed));
        assert!(Range::new(-3, -1).may_stop_division_of(all, &signed));
        assert!(!Range::new(-3, -1).may_stop_division_of(Range::new(-5, 5), &signed));
        assert!(!Range::new(1, 3).may_stop_division_of(all, &signed));
    }
}
