//! The types of columns.

use std::fmt;

/// The type of a column. In memory each value is a number. `bool` and states have their own text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ColumnType<'a> {
    /// Finite numbers.
    Number,
    /// Integers in a range. `f64` holds both limits exactly.
    Whole {
        /// The smallest value.
        least: i64,
        /// The largest value.
        largest: i64,
    },
    /// `true` and `false`, stored as 1 and 0.
    Bool,
    /// Names of states, stored as indices into the list.
    State {
        /// The name of the type of state.
        name: &'a str,
        /// The names of the states.
        states: &'a [&'a str],
    },
}

impl ColumnType<'_> {
    /// Parses a value of this type. Returns `None` if the text is not one.
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

    /// The text of a value, which [`Self::parse`] reads back. A number that is not the index of a state stays
    /// a number.
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

/// Describes what a text must be.
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
