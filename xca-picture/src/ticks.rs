//! The round numbers along a scale.

use xca_io::numbers::significant;

/// The round numbers of a scale.
#[derive(Debug, PartialEq)]
pub(crate) struct Ticks {
    /// Value and label of each, ascending, all within the scale.
    pub(crate) marks: Vec<(f64, String)>,
    /// The labels must be multiplied by ten to this power.
    pub(crate) exponent: i32,
}

/// About `wanted` round numbers (steps of 1, 2 or 5 times a power of ten) between `low` and `high`.
pub(crate) fn ticks(low: f64, high: f64, wanted: usize) -> Ticks {
    let span = high - low;
    // The arithmetic below cannot divide such spans. They count as empty.
    if !(span.is_finite() && span > 1e-300 && span > 1e-12 * low.abs().max(high.abs())) {
        return Ticks { marks: vec![(low, significant(low, 4))], exponent: 0 };
    }
    let largest = low.abs().max(high.abs());
    let magnitude = largest.log10().floor() as i32;
    let exponent = if (-3..5).contains(&magnitude) { 0 } else { magnitude };
    let step = Step::about(span / wanted.max(1) as f64);
    let decimals = usize::try_from(exponent - step.power).unwrap_or(0);
    let marks = step
        .multiples(low, high)
        .map(|value| (value.clamp(low, high), format!("{:.decimals$}", value / ten_to(exponent) + 0.0)));
    Ticks { marks: marks.collect(), exponent }
}

/// About `wanted` round numbers between `low` and `high`, with commas: `4,251,000`. Empty if the span is too
/// small for the numbers.
pub(crate) fn coordinates(low: f64, high: f64, wanted: usize) -> Vec<(f64, String)> {
    let (span, largest) = (high - low, low.abs().max(high.abs()));
    if !(span.is_finite() && span > 1e-12 * largest && (1e-300..1e15).contains(&largest)) {
        return Vec::new();
    }
    let step = Step::about(span / wanted.max(1) as f64);
    let decimals = usize::try_from(-step.power).unwrap_or(0);
    let multiples = step.multiples(low, high);
    multiples.map(|value| (value.clamp(low, high), with_commas(&format!("{value:.decimals$}")))).collect()
}

/// Adds a comma before each three digits of the integer part.
fn with_commas(decimal: &str) -> String {
    let (sign, digits) = decimal.strip_prefix('-').map_or(("", decimal), |digits| ("-", digits));
    let (whole, rest) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    let mut text = sign.to_owned();
    for (at, digit) in whole.chars().enumerate() {
        if at > 0 && (whole.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text + rest
}

/// A round distance: 1, 2 or 5 times a power of ten.
struct Step {
    length: f64,
    /// The power of ten of its last digit.
    power: i32,
}

impl Step {
    /// The step nearest to a positive number.
    fn about(rough: f64) -> Self {
        let power = rough.log10().floor() as i32;
        let (factor, power) = match rough / ten_to(power) {
            ..1.5 => (1.0, power),
            ..3.5 => (2.0, power),
            ..7.5 => (5.0, power),
            _ => (1.0, power + 1),
        };
        Self { length: factor * ten_to(power), power }
    }

    /// Its multiples in a range.
    fn multiples(&self, low: f64, high: f64) -> impl Iterator<Item = f64> {
        let length = self.length;
        let first = (low / length - 1e-9).ceil() as i64;
        let last = (high / length + 1e-9).floor() as i64;
        // Adding zero removes the sign of -0.
        (first..=last).map(move |number| number as f64 * length + 0.0)
    }
}

fn ten_to(power: i32) -> f64 {
    10.0_f64.powi(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64) -> (Vec<String>, i32) {
        let ticks = ticks(low, high, 5);
        (ticks.marks.into_iter().map(|(_, label)| label).collect(), ticks.exponent)
    }

    #[test]
    fn ticks_are_round_numbers_within_the_scale() {
        assert_eq!(
            labels(0.0, 1.0),
            (["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"].map(String::from).to_vec(), 0)
        );
        assert_eq!(labels(-3.0, 7.2), (["-2", "0", "2", "4", "6"].map(String::from).to_vec(), 0));
        assert_eq!(labels(0.0, 4.3e-7), (["0", "1", "2", "3", "4"].map(String::from).to_vec(), -7));
        assert_eq!(labels(1e6, 2e6).1, 6);
        assert_eq!(labels(0.0, 95.0), (["0", "20", "40", "60", "80"].map(String::from).to_vec(), 0));
        let ticks = ticks(0.1, 0.3, 4);
        assert!(ticks.marks.iter().all(|(value, _)| (0.1..=0.3).contains(value)), "{ticks:?}");
        assert_eq!(ticks.marks.len(), 5);
    }

    #[test]
    fn coordinates_are_written_out() {
        let texts = |low: f64, high: f64, wanted: usize| -> Vec<String> {
            coordinates(low, high, wanted).into_iter().map(|(_, text)| text).collect()
        };
        assert_eq!(texts(4_250_400.0, 4_252_100.0, 4), ["4,250,500", "4,251,000", "4,251,500", "4,252,000"]);
        assert_eq!(texts(-1200.0, 900.0, 2), ["-1,000", "0"]);
        assert_eq!(texts(0.0, 1.0, 2), ["0.0", "0.5", "1.0"]);
        assert_eq!(texts(-0.1, 0.1, 2), ["-0.1", "0.0", "0.1"]);
        assert_eq!(texts(999.0, 1001.0, 4), ["999.0", "999.5", "1,000.0", "1,000.5", "1,001.0"]);
        assert_eq!(texts(0.0, 95_000.0, 1), ["0"]);
        for [low, high] in [[1.0, 1.0], [f64::NAN, 1.0], [1e15, 2e15], [0.0, 0.0], [f64::MIN, f64::MAX]] {
            assert!(texts(low, high, 4).is_empty(), "{low} {high}");
        }
    }

    #[test]
    fn a_scale_without_extent_has_one_tick() {
        assert_eq!(labels(2.5, 2.5), (vec!["2.5".to_owned()], 0));
        assert_eq!(labels(f64::NAN, 1.0).0.len(), 1);
        assert_eq!(labels(1.0, 0.0).0.len(), 1);
        assert_eq!(labels(0.0, 5e-324).0.len(), 1);
        assert_eq!(labels(f64::MIN, f64::MAX).0.len(), 1);
        assert!(labels(0.0, 1e-299).0.len() > 3);
        assert!(labels(1.0, 1.0 + 1e-11).0.len() < 12);
    }
}
