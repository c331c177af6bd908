//! Ranges of parameters.

use crate::value::{Precision, Shortest};
use std::fmt;

/// An interval of numbers. A missing end is unlimited.
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
    /// Whether the interval includes the end.
    pub included: bool,
}

impl Interval {
    /// All numbers.
    pub const ALL: Self = Self { low: None, high: None };

    /// Whether the number is in the interval. NaN is in none.
    pub fn contains(&self, number: f64) -> bool {
        let above = self.low.is_none_or(|end| number > end.number || (end.included && number == end.number));
        let below = self.high.is_none_or(|end| number < end.number || (end.included && number == end.number));
        above && below && !number.is_nan()
    }

    /// The interval in mathematical notation: `[0, 1)`, `> 0`, `≤ 5`. Empty for all numbers.
    pub fn notation(&self) -> String {
        let number = |end: End| Shortest(end.number);
        match (self.low, self.high) {
            (None, None) => String::new(),
            (Some(low), None) => format!("{} {}", if low.included { "≥" } else { ">" }, number(low)),
            (None, Some(high)) => format!("{} {}", if high.included { "≤" } else { "<" }, number(high)),
            (Some(low), Some(high)) => {
                let left = if low.included { '[' } else { '(' };
                let right = if high.included { ']' } else { ')' };
                format!("{left}{}, {}{right}", number(low), number(high))
            }
        }
    }

    /// The interval with its ends rounded to a precision, for comparison with rounded numbers.
    pub fn rounded(&self, precision: Precision) -> Self {
        let rounded = |end: End| End { number: precision.rounded(end.number), ..end };
        Self { low: self.low.map(rounded), high: self.high.map(rounded) }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let low = self.low.map(|end| {
            let word = if end.included { "at least" } else { "above" };
            format!("{word} {}", Shortest(end.number))
        });
        let high = self.high.map(|end| {
            if !end.included && end.number == f64::INFINITY {
                return "finite".to_owned();
            }
            let word = if end.included { "at most" } else { "below" };
            format!("{word} {}", Shortest(end.number))
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
        // In f32 the number rounds to 1, which is not in the interval.
        let nearly_one = 1.0 - 1e-12;
        assert!(half_open.contains(nearly_one));
        assert!(!half_open.rounded(Precision::F32).contains(Precision::F32.rounded(nearly_one)));
        let tenth = Interval { low: None, high: Some(End { number: 0.1, included: true }) };
        assert!(tenth.rounded(Precision::F32).contains(Precision::F32.rounded(0.1)));
    }

    #[test]
    fn intervals_are_written_in_few_characters() {
        let end = |number: f64, included: bool| Some(End { number, included });
        for (low, high, words, notation) in [
            (end(0.0, true), end(1.0, false), "at least 0 and below 1", "[0, 1)"),
            (end(0.0, false), None, "above 0", "> 0"),
            (end(0.0, true), end(f64::INFINITY, false), "at least 0 and finite", "[0, inf)"),
            (None, end(1e300, true), "at most 1e300", "≤ 1e300"),
            (
                end(-1e15, false),
                end(1e-7, true),
                "above -1000000000000000 and at most 1e-7",
                "(-1000000000000000, 1e-7]",
            ),
            (None, None, "any number", ""),
        ] {
            let interval = Interval { low, high };
            assert_eq!((interval.to_string().as_str(), interval.notation().as_str()), (words, notation));
        }
        let infinite = Interval { low: end(f64::NEG_INFINITY, true), high: end(f64::INFINITY, true) };
        assert_eq!(infinite.notation(), "[-inf, inf]");
    }
}
