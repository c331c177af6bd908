//! Numbers as options of a program: out of range, NaN or infinite, they are refused with the range.

use std::ops::{Bound, RangeBounds};
use xca_core::{End, Interval};

/// A value parser for numbers in a range.
///
/// ```
/// use xca_run::prelude::*;
///
/// #[derive(Args)]
/// struct Pool {
///     /// The temperature at the start, in °C
///     #[arg(long, default_value_t = 20.0, value_parser = number_in(-273.15..))]
///     temperature: f64,
///     /// The length of a side, in m
///     #[arg(long, default_value_t = 10.0, value_parser = positive_number)]
///     side: f64,
/// }
///
/// assert!(number_in(0.0..=1.0)("nan").is_err());
/// assert_eq!(positive_number("0").unwrap_err(), "it must be a finite number above 0");
/// ```
pub fn number_in(
    range: impl RangeBounds<f64>,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    let interval = Interval { low: end(range.start_bound()), high: end(range.end_bound()) };
    move |text| parse(text, interval)
}

/// A value parser for numbers above 0.
///
/// # Errors
/// Where the text is no number above 0.
pub fn positive_number(text: &str) -> Result<f64, String> {
    parse(text, Interval { low: Some(End { number: 0.0, included: false }), high: None })
}

/// A value parser for whole numbers, such as a number of cells.
///
/// # Errors
/// Where the text is no whole number, or one that is too large.
pub fn whole_number(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| format!("it must be a whole number from 0 to {}", usize::MAX))
}

fn end(bound: Bound<&f64>) -> Option<End> {
    match bound {
        Bound::Included(&number) => Some(End { number, included: true }),
        Bound::Excluded(&number) => Some(End { number, included: false }),
        Bound::Unbounded => None,
    }
}

fn parse(text: &str, interval: Interval) -> Result<f64, String> {
    text.parse().ok().filter(|number: &f64| number.is_finite() && interval.contains(*number)).ok_or_else(
        || match interval {
            Interval::ALL => "it must be a finite number".to_owned(),
            _ => format!("it must be a finite number {interval}"),
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_told_from_others() {
        assert_eq!(whole_number("64"), Ok(64));
        for text in ["-1", "1.5", "1e3", "", "99999999999999999999", "sixty"] {
            let said = whole_number(text).unwrap_err();
            assert!(said.starts_with("it must be a whole number from 0 to "), "{text}: {said}");
        }
    }

    #[test]
    fn numbers_out_of_range_are_refused_with_the_range() {
        for (text, wanted) in [
            ("0.5", Ok(0.5)),
            ("0", Ok(0.0)),
            ("1", Err("it must be a finite number at least 0 and below 1")),
            ("-1e-9", Err("it must be a finite number at least 0 and below 1")),
            ("NaN", Err("it must be a finite number at least 0 and below 1")),
            ("half", Err("it must be a finite number at least 0 and below 1")),
        ] {
            assert_eq!(number_in(0.0..1.0)(text), wanted.map_err(str::to_owned), "{text}");
        }
        assert_eq!(number_in(..)("-3"), Ok(-3.0));
        assert_eq!(number_in(..)("nan"), Err("it must be a finite number".to_owned()));
        assert_eq!(positive_number("1e-300"), Ok(1e-300));
        assert!(positive_number("0").is_err());
        assert_eq!(number_in(0.0..)("inf"), Err("it must be a finite number at least 0".to_owned()));
    }
}
