//! How often something happens: every so many steps, or after so much time.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

/// A number of steps or a wall-clock time.
///
/// ```
/// use std::time::Duration;
/// use xca_checkpoint::Interval;
///
/// assert_eq!("500".parse::<Interval>(), Ok(Interval::Steps(500)));
/// assert_eq!("10min".parse::<Interval>(), Ok(Interval::Time(Duration::from_secs(600))));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interval {
    /// Steps, at least 1.
    Steps(u64),
    /// Wall-clock time.
    Time(Duration),
}

/// The units of time with their seconds.
const UNITS: [(&str, f64); 4] = [("s", 1.0), ("min", 60.0), ("h", 3600.0), ("d", 86_400.0)];

impl FromStr for Interval {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const WANTED: &str =
            "it must be a number of steps, such as 500, or a time, such as 30s, 10min or 1.5h";
        let (number, unit) =
            text.split_at(text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len()));
        if unit.is_empty() {
            return match number.trim().parse() {
                Ok(0) => Err("the interval must be at least 1 step"),
                Ok(steps) => Ok(Self::Steps(steps)),
                Err(_) => Err(WANTED),
            };
        }
        let (_, seconds) = UNITS.iter().find(|(name, _)| *name == unit).ok_or(WANTED)?;
        let number: f64 = number.trim().parse().map_err(|_| WANTED)?;
        let time = Duration::try_from_secs_f64(number * seconds).map_err(|_| WANTED)?;
        if time.is_zero() { Err("a time must be longer than 0 s") } else { Ok(Self::Time(time)) }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Steps(steps) => write!(f, "{steps}"),
            Self::Time(time) => write!(f, "{}s", time.as_secs_f64()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_steps_or_times() {
        let seconds = |seconds: f64| Ok(Interval::Time(Duration::from_secs_f64(seconds)));
        for (text, wanted) in [
            ("500", Ok(Interval::Steps(500))),
            ("30s", seconds(30.0)),
            ("0.25s", seconds(0.25)),
            ("10min", seconds(600.0)),
            ("1.5 h", seconds(5400.0)),
            ("2d", seconds(172_800.0)),
        ] {
            assert_eq!(text.parse::<Interval>(), wanted, "{text}");
        }
        for text in ["", "0", "-5", "1.5", "s", "5 weeks", "-1s", "0s", "infs", "nans", "1e300h", "10m"] {
            assert!(text.parse::<Interval>().is_err(), "{text}");
        }
        assert_eq!(
            (Interval::Steps(7).to_string(), "10min".parse::<Interval>().unwrap().to_string()),
            ("7".into(), "600s".into())
        );
    }
}
