//! Which numbers a parameter can be.

use crate::value::Precision;
use std::fmt;

/// An interval of numbers; without an end it goes on for ever.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Interval {
    /// The lower end.
    pub low: Option<End>,
    /// The upper end.
    pub high: Option<End>,
}

/// An end of an [`Interval`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// The number.
    pub number: f64,
    /// Whether it belongs to the interval.
    pub included: bool,
}

impl Interval {
    /// All numbers.
    pub const ALL: Self = Self { low: None, high: None };

    /// Whether the number lies in the interval; NaN lies in none.
    pub fn contains(&self, number: f64) -> bool {
        let above = self.low.is_none_or(|end| number > end.number || (end.included && number == end.number));
        let below = self.high.is_none_or(|end| number < end.number || (end.included && number == end.number));
        above && below && !number.is_nan()
    }

    /// The interval with its ends rounded to a precision, to be compared with numbers that are rounded too.
    pub(crate) fn rounded(&self, precision: Precision) -> Self {
        let rounded = |end: End| End { number: precision.rounded(end.number), ..end };
        Self { low: self.low.map(rounded), high: self.high.map(rounded) }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let low = self.low.map(|end| {
            let word = if end.included { "at least" } else { "above" };
            format!("{word} {}", end.number)
        });
        let high = self.high.map(|end| {
            let word = if end.included { "at most" } else { "below" };
            format!("{word} {}", end.number)
        });
        match (low, high) {
            (Some(low), Some(high)) => write!(f, "{low} and {high}"),
            (Some(one), None) | (None, Some(one)) => f.write_str(&one),
            (None, None) => f.write_str("any number"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{End, Interval};
    use crate::value::Precision;

    #[test]
    fn ends_belong_to_it_or_not() {
        let half_open = Interval {
            low: Some(End { number: 0.0, included: true }),
            high: Some(End { number: 1.0, included: false }),
        };
        assert_eq!(half_open.to_string(), "at least 0 and below 1");
        assert_eq!(
            [-1e-300, 0.0, 0.5, 1.0].map(|number| half_open.contains(number)),
            [false, true, true, false]
        );
        assert!(!half_open.contains(f64::NAN));
        assert!(!Interval::ALL.contains(f64::NAN));
        assert!(Interval::ALL.contains(f64::INFINITY));
        // In f32 the number is 1, which does not belong to it.
        let nearly_one = 1.0 - 1e-12;
        assert!(half_open.contains(nearly_one));
        assert!(!half_open.rounded(Precision::F32).contains(Precision::F32.rounded(nearly_one)));
        let tenth = Interval { low: None, high: Some(End { number: 0.1, included: true }) };
        assert!(tenth.rounded(Precision::F32).contains(Precision::F32.rounded(0.1)));
    }
}
