//! The steps after which a state is written.

use serde::{Deserialize, Serialize};
use std::fmt;

/// The steps after which a state is written. The initial and the last state are always written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "Spelt", try_from = "Spelt")]
pub enum Outputs {
    /// An interval in steps, at least 1.
    Every(u64),
    /// Growing intervals: after each of the first 8 steps, then four times until the number of steps has
    /// doubled. For runs of unknown length: 1,000 steps give 36 states, a million 76.
    Growing,
}

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Spelt {
    Number(u64),
    Word(String),
}

const GROWING: &str = "growing";

impl From<Outputs> for Spelt {
    fn from(outputs: Outputs) -> Self {
        match outputs {
            Outputs::Every(steps) => Self::Number(steps),
            Outputs::Growing => Self::Word(GROWING.to_owned()),
        }
    }
}

impl TryFrom<Spelt> for Outputs {
    type Error = String;

    fn try_from(spelt: Spelt) -> Result<Self, String> {
        match spelt {
            Spelt::Number(0) => Err("the interval must be at least 1 step".to_owned()),
            Spelt::Number(steps) => Ok(Self::Every(steps)),
            Spelt::Word(word) if word == GROWING => Ok(Self::Growing),
            Spelt::Word(word) => Err(format!("`{word}` is neither a number of steps nor `{GROWING}`")),
        }
    }
}

impl Outputs {
    /// The interval to the next output, at a step.
    fn interval(self, step: u64) -> u64 {
        match self {
            Self::Every(steps) => steps.max(1),
            // A quarter of the largest power of 2 up to the step.
            Self::Growing => 1 << step.max(1).ilog2().saturating_sub(2),
        }
    }

    /// Whether the state after `step` steps is written.
    pub fn is_due(self, step: u64) -> bool {
        step.is_multiple_of(self.interval(step))
    }

    /// The next step with an output.
    pub fn next(self, step: u64) -> u64 {
        let interval = self.interval(step);
        (step / interval + 1).saturating_mul(interval)
    }
}

impl fmt::Display for Outputs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Every(steps) => write!(f, "{steps}"),
            Self::Growing => f.write_str(GROWING),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(outputs: Outputs, last: u64) -> Vec<u64> {
        (0..=last).filter(|step| outputs.is_due(*step)).collect()
    }

    #[test]
    fn growing_intervals_divide_each_octave_by_four() {
        let wanted = [0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64];
        assert_eq!(all(Outputs::Growing, 64), wanted);
        assert_eq!((all(Outputs::Growing, 1000).len(), all(Outputs::Growing, 1_000_000).len()), (36, 76));
        assert_eq!(all(Outputs::Every(7), 22), [0, 7, 14, 21]);
    }

    #[test]
    fn the_next_is_the_next_that_is_due() {
        for outputs in [Outputs::Growing, Outputs::Every(1), Outputs::Every(9)] {
            for step in 0..3000 {
                let next = (step + 1..).find(|next| outputs.is_due(*next)).unwrap();
                assert_eq!(outputs.next(step), next, "{outputs} after {step}");
            }
        }
        assert_eq!(Outputs::Growing.next(u64::MAX), u64::MAX);
        assert_eq!(Outputs::Every(u64::MAX).next(3), u64::MAX);
    }

    #[test]
    fn json_keeps_them() {
        for (outputs, text) in [(Outputs::Every(50), "50"), (Outputs::Growing, "\"growing\"")] {
            assert_eq!(serde_json::to_string(&outputs).unwrap(), text);
            assert_eq!(serde_json::from_str::<Outputs>(text).unwrap(), outputs);
        }
        for wrong in ["0", "\"often\"", "-1", "null"] {
            assert!(serde_json::from_str::<Outputs>(wrong).is_err(), "{wrong}");
        }
    }
}
