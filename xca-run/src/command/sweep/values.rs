//! Many values of a parameter, as the command line says them.

use crate::program::Assignment;

/// A parameter with the values that it takes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Values {
    pub(super) parameter: String,
    pub(super) values: Vec<String>,
}

/// Values that make no sense.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub(super) enum ValuesError {
    #[error(
        "`{text}` must be of the form LOW..HIGH:COUNT, such as 0.1..0.5:20, with finite numbers and a count of at least 2"
    )]
    Range { text: String },
    #[error("`{text}` lacks a value between two |")]
    Empty { text: String },
}

/// More are a mistake: each value is a run.
const MOST: usize = 1_000_000;

impl Values {
    /// The values of an assignment; nothing where it has one alone.
    pub(super) fn of(assignment: &Assignment) -> Result<Option<Self>, ValuesError> {
        let text = &assignment.value;
        let values = if text.contains('|') {
            let values: Vec<String> = text.split('|').map(|value| value.trim().to_owned()).collect();
            if values.iter().any(String::is_empty) {
                return Err(ValuesError::Empty { text: assignment.to_string() });
            }
            values
        } else if text.contains("..") {
            range(text).ok_or_else(|| ValuesError::Range { text: assignment.to_string() })?
        } else {
            return Ok(None);
        };
        Ok(Some(Self { parameter: assignment.name.clone(), values }))
    }
}

/// Numbers at equal distances, with both ends.
fn range(text: &str) -> Option<Vec<String>> {
    let (low, rest) = text.split_once("..")?;
    let (high, count) = rest.split_once(':')?;
    let [low, high] = [low, high].map(|text| text.trim().parse::<f64>().ok().filter(|end| end.is_finite()));
    let (low, high) = (low?, high?);
    let count: usize = count.trim().parse().ok().filter(|count| (2..=MOST).contains(count))?;
    let last = (count - 1) as f64;
    let value = |number: usize| {
        let number = number as f64;
        // Halved, so that no sum overflows.
        2.0 * ((0.5 * low) * ((last - number) / last) + (0.5 * high) * (number / last))
    };
    let exact = |number: usize| match number {
        0 => low,
        number if number == count - 1 => high,
        number => value(number),
    };
    Some((0..count).map(|number| shortest(exact(number))).collect())
}

/// The number with at most 15 digits, which hide what rounding has left.
fn shortest(number: f64) -> String {
    format!("{number:.14e}").parse::<f64>().unwrap_or(number).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Option<Vec<String>>, ValuesError> {
        let assignment = Assignment { name: "rate".to_owned(), value: text.to_owned() };
        Values::of(&assignment).map(|values| values.map(|values| values.values))
    }

    #[test]
    fn ranges_have_equal_steps_and_both_ends() {
        assert_eq!(of("0.1..0.5:5").unwrap().unwrap(), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(of("3..1:3").unwrap().unwrap(), ["3", "2", "1"]);
        assert_eq!(of("-1e300..1e300:3").unwrap().unwrap()[1], "0");
        let ends = of("0.123456789012345678..7:9").unwrap().unwrap();
        assert_eq!(ends[0].parse::<f64>(), Ok(0.123_456_789_012_346));
    }

    #[test]
    fn lists_are_texts_and_one_value_is_none() {
        assert_eq!(of("1,2 | 3,4").unwrap().unwrap(), ["1,2", "3,4"]);
        assert_eq!(of("Water|Rock").unwrap().unwrap(), ["Water", "Rock"]);
        assert_eq!(of("0.5").unwrap(), None);
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        for text in
            ["0..1", "0..1:1", "0..1:x", "a..1:3", "0..inf:3", "nan..1:3", "0..1:99999999", "..", "1..:2"]
        {
            assert!(matches!(of(text), Err(ValuesError::Range { .. })), "{text}");
        }
        for text in ["1||2", "|", "1|"] {
            assert!(matches!(of(text), Err(ValuesError::Empty { .. })), "{text}");
        }
    }
}
