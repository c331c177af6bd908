//! The round numbers that stand along a scale.

use xca_io::numbers::significant;

/// The round numbers of a scale.
#[derive(Debug, PartialEq)]
pub(crate) struct Ticks {
    /// Value and label of each, ascending, all within the scale.
    pub(crate) marks: Vec<(f64, String)>,
    /// The labels have to be multiplied by ten to this power.
    pub(crate) exponent: i32,
}

/// About `wanted` round numbers (steps of 1, 2 or 5 times a power of ten) between `low` and `high`.
pub(crate) fn ticks(low: f64, high: f64, wanted: usize) -> Ticks {
    let span = high - low;
    // Spans that the arithmetic below cannot divide count as none.
    if !(span.is_finite() && span > 1e-300 && span > 1e-12 * low.abs().max(high.abs())) {
        return Ticks { marks: vec![(low, significant(low, 4))], exponent: 0 };
    }
    let largest = low.abs().max(high.abs());
    let magnitude = largest.log10().floor() as i32;
    let exponent = if (-3..5).contains(&magnitude) { 0 } else { magnitude };
    let rough = span / wanted.max(1) as f64;
    let power = rough.log10().floor() as i32;
    let factor = match rough / ten_to(power) {
        ..1.5 => 1.0,
        ..3.5 => 2.0,
        ..7.5 => 5.0,
        _ => 10.0,
    };
    let step = factor * ten_to(power);
    let decimals = usize::try_from(exponent - power - i32::from(factor == 10.0)).unwrap_or(0);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let marks = (first..=last)
        .map(|i| {
            let value = i as f64 * step;
            (value.clamp(low, high), format!("{:.decimals$}", value / ten_to(exponent) + 0.0))
        })
        .collect();
    Ticks { marks, exponent }
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
