//! The engine beside a loop by hand.

use crate::timing::Times;
use std::error::Error;
use std::fmt;

/// A comparison of the engine with the loop by hand.
#[derive(Debug)]
pub(crate) struct Comparison {
    /// The model and its size.
    name: String,
    /// The number of cells.
    cells: usize,
    /// Seconds a step of the engine.
    engine: Times,
    /// Seconds a step of the loop by hand.
    by_hand: Times,
}

impl Comparison {
    /// Of the times of so many steps: first the engine's, then those of the loop by hand.
    pub(crate) fn new(
        name: String,
        cells: usize,
        steps: usize,
        times: Vec<Times>,
    ) -> Result<Self, Box<dyn Error>> {
        let [engine, by_hand] = <[Times; 2]>::try_from(times).map_err(|_| "two contenders")?;
        Ok(Self { name, cells, engine: engine.per(steps), by_hand: by_hand.per(steps) })
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = self.engine.spread();
        let (hand_low, hand_high) = self.by_hand.spread();
        write!(
            f,
            "{}: engine {:.2} ms a step ({:.2} to {:.2}), by hand {:.2} ms ({:.2} to {:.2}), ratio {:.3}; {:.1} million cells a second",
            self.name,
            self.engine.median() * 1e3,
            low * 1e3,
            high * 1e3,
            self.by_hand.median() * 1e3,
            hand_low * 1e3,
            hand_high * 1e3,
            self.engine.median() / self.by_hand.median(),
            self.cells as f64 / self.engine.median() / 1e6,
        )
    }
}
