//! What the texts of a column mean.

use std::fmt;

/// What the values of a column are. In memory each is a number; `bool` and states have texts of their own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ColumnType<'a> {
    /// Finite numbers.
    Number,
    /// Whole numbers from the least to the largest; both fit into `f64` exactly.
    Whole {
        /// The least.
        least: i64,
        /// The largest.
        largest: i64,
    },
    /// `true` and `false`, in memory 1 and 0.
    Bool,
    /// Names of states, in memory by their places in the list.
    State {
        /// What such a state is called.
        name: &'a str,
        /// The names.
        states: &'a [&'a str],
    },
}

impl ColumnType<'_> {
    /// The number that a text means; nothing where the text is no value of this type.
    pub fn parse(&self, text: &str) -> Option<f64> {
        match *self {
            Self::Number => text.parse().ok().filter(|number: &f64| number.is_finite()),
            Self::Whole { least, largest } => {
                let within =
                    |number: &f64| number.fract() == 0.0 && (least as f64..=largest as f64).contains(number);
                text.parse().ok().filter(within)
            }
            Self::Bool => text.parse().ok().map(|value: bool| value.into()),
            Self::State { states, .. } => {
                states.iter().position(|state| *state == text).map(|number| number as f64)
            }
        }
    }

    /// The number as a text that [`Self::parse`] reads back. A number that stands for no state stays a
    /// number.
    pub fn text(&self, number: f64) -> String {
        match *self {
            Self::Number => format!("{number:.16e}"),
            Self::Whole { .. } => number.to_string(),
            Self::Bool => (number != 0.0).to_string(),
            Self::State { states, .. } => {
                let name = states.get(number as usize);
                name.map_or_else(|| number.to_string(), |name| (*name).to_owned())
            }
        }
    }
}

/// What a text must be to be a value of this type.
impl fmt::Display for ColumnType<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Number => f.write_str("must be a finite number"),
            Self::Whole { least, largest } => write!(f, "must be a whole number from {least} to {largest}"),
            Self::Bool => f.write_str("must be true or false"),
            Self::State { name, states } => write!(f, "must be a {name}: {}", states.join(", ")),
        }
    }
}
