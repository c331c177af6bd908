//! Numbers as people read them.

/// `value` with at most `digits` significant digits, without trailing zeros: whole numbers as such, others with a point
/// where that takes few characters (`0.0112405`, `315979`), else with an exponent (`1.2e-7`).
pub fn significant(value: f64, digits: usize) -> String {
    let digits = digits.max(1);
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { format!("{value}") };
    }
    if value.fract() == 0.0 && value.abs() < 1e12 {
        return format!("{value}");
    }
    // Rounding first, so that 9.9999999 is seen as 10.
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

/// A number of things, of which the name is given for one: `1 step`, `20 steps`.
pub fn counted(number: u64, thing: &str) -> String {
    let ending = if number == 1 { "" } else { "s" };
    format!("{number} {thing}{ending}")
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
}
