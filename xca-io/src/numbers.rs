//! Numbers formatted for people.

use std::time::Duration;

/// `value` with at most `digits` significant digits, without trailing zeros. Integers have no point. Other
/// values have a point where that is short (`0.0112405`, `315979`), otherwise an exponent (`1.2e-7`).
pub fn significant(value: f64, digits: usize) -> String {
    let digits = digits.max(1);
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { format!("{value}") };
    }
    if value.fract() == 0.0 && value.abs() < 1e12 {
        return format!("{value}");
    }
    // Round first, so that 9.9999999 becomes 10.
    let scientific = format!("{value:.*e}", digits - 1);
    let exponent = scientific.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok()).unwrap_or(0);
    if (-4..digits.min(12) as i32).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        without_trailing_zeros(&format!("{value:.decimals$}")).to_owned()
    } else {
        let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
        format!("{}e{exponent}", without_trailing_zeros(mantissa))
    }
}

/// A number of things, with the noun in the singular: `1 step`, `20 steps`.
pub fn counted(number: u64, thing: &str) -> String {
    let ending = if number == 1 { "" } else { "s" };
    format!("{number} {thing}{ending}")
}

/// A rate for people: `1.23e6`, `812.4` or `0.51` steps a second. Below 0.1 steps a second it is in seconds a
/// step.
#[must_use]
pub fn rate_text(steps_per_second: f64) -> String {
    match steps_per_second {
        rate if !rate.is_finite() || rate <= 0.0 => "- steps/s".to_owned(),
        rate if rate < 0.1 => format!("{} s/step", significant(1.0 / rate, 3)),
        rate if rate < 1e4 => format!("{} steps/s", significant(rate, if rate < 100.0 { 3 } else { 4 })),
        rate if rate < 1e6 => format!("{rate:.0} steps/s"),
        rate => format!("{rate:.2e} steps/s"),
    }
}

/// A duration for people: `0.8 s`, `42 s`, `3 min 05 s`, `2 h 07 min` or `4 d 03 h`.
#[must_use]
pub fn duration_text(duration: Duration) -> String {
    let seconds = duration.as_secs();
    match seconds {
        0..10 => format!("{:.1} s", duration.as_secs_f64()),
        10..60 => format!("{seconds} s"),
        60..3600 => format!("{} min {:02} s", seconds / 60, seconds % 60),
        3600..86_400 => format!("{} h {:02} min", seconds / 3600, seconds / 60 % 60),
        _ => format!("{} d {:02} h", seconds / 86_400, seconds / 3600 % 24),
    }
}

fn without_trailing_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_digits_and_no_needless_zeros() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (315_979.0, "315979"),
            (0.011_240_501, "0.0112405"),
            (1.118_033_988_7e-5, "1.11803e-5"),
            (-2.5, "-2.5"),
            (9.999_999_9, "10"),
            (123_456.789, "123457"),
            (1_234_567.89, "1.23457e6"),
            (6.022e23, "6.022e23"),
            (0.000_123, "0.000123"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(significant(value, 6), text);
        }
        assert_eq!(significant(3.17, 1), "3");
        assert_eq!(significant(31.7, 1), "3e1");
    }

    #[test]
    fn rates_and_durations_are_short() {
        for (rate, text) in [
            (1.0e7, "1.00e7 steps/s"),
            (29_460.4, "29460 steps/s"),
            (812.36, "812.4 steps/s"),
            (4.5678, "4.57 steps/s"),
            (0.025, "40 s/step"),
            (0.0, "- steps/s"),
            (f64::INFINITY, "- steps/s"),
        ] {
            assert_eq!(rate_text(rate), text);
        }
        for (seconds, text) in [
            (0.81, "0.8 s"),
            (42.9, "42 s"),
            (185.0, "3 min 05 s"),
            (7620.0, "2 h 07 min"),
            (86_400.0 * 4.0 + 3.0 * 3600.0, "4 d 03 h"),
        ] {
            assert_eq!(duration_text(Duration::from_secs_f64(seconds)), text);
        }
    }
}
