//! Value parsers for numbers on the command line: NaN and infinities are refused, and the message says what is wanted.
//!
//! ```
//! use xca_run::prelude::*;
//!
//! #[derive(Args)]
//! struct Plate {
//!     /// Length of a side, in m
//!     #[arg(long, default_value_t = 0.1, value_parser = parse_positive)]
//!     side: f64,
//! }
//! ```

/// Text that is no number of the kind that an option takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NumberError {
    /// Not a finite number.
    #[error("it must be a finite number, such as 0.5")]
    NotFinite,
    /// Not a finite number above 0.
    #[error("it must be a finite number above 0, such as 0.5")]
    NotPositive,
    /// Not a finite number from 0 on.
    #[error("it must be a finite number, at least 0, such as 0.5")]
    Negative,
}

/// Reads a finite number.
///
/// # Errors
/// If the text is no number, NaN or infinite.
pub fn parse_finite(text: &str) -> Result<f64, NumberError> {
    text.trim().parse().ok().filter(|number: &f64| number.is_finite()).ok_or(NumberError::NotFinite)
}

/// Reads a finite number above 0.
///
/// # Errors
/// If the text is no such number.
pub fn parse_positive(text: &str) -> Result<f64, NumberError> {
    parse_finite(text).ok().filter(|number| *number > 0.0).ok_or(NumberError::NotPositive)
}

/// Reads a finite number, at least 0.
///
/// # Errors
/// If the text is no such number.
pub fn parse_not_negative(text: &str) -> Result<f64, NumberError> {
    parse_finite(text).ok().filter(|number| *number >= 0.0).ok_or(NumberError::Negative)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_finite() {
        assert_eq!(parse_finite(" -1e300 "), Ok(-1e300));
        assert_eq!([parse_positive("1e-9"), parse_not_negative("0")], [Ok(1e-9), Ok(0.0)]);
        for text in ["nan", "-NaN", "inf", "-infinity", "1e999", "", "1,5", "two"] {
            assert_eq!(parse_finite(text), Err(NumberError::NotFinite), "{text}");
            assert_eq!(parse_positive(text), Err(NumberError::NotPositive), "{text}");
            assert_eq!(parse_not_negative(text), Err(NumberError::Negative), "{text}");
        }
        assert_eq!([parse_positive("0"), parse_positive("-1")], [Err(NumberError::NotPositive); 2]);
        assert_eq!(parse_not_negative("-1e-300"), Err(NumberError::Negative));
    }
}
