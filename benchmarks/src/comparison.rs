//! The engine beside a loop by hand.

use crate::timing::Times;
use std::error::Error;

/// A comparison of the engine with the loop by hand.
#[derive(Debug)]
pub(crate) struct Comparison {
    /// The model and its size.
    name: String,
    /// The number of cells.
    cells: usize,
    /// The bytes that a cell reads and writes in a step at least.
    bytes: usize,
    /// Seconds a step of the engine.
    engine: Times,
    /// Seconds a step of the loop by hand.
    by_hand: Times,
}

impl Comparison {
    /// Of the times of so many steps: first the engine's, then those of the loop by hand. A step reads and
    /// writes `bytes` of each cell.
    pub(crate) fn new(
        name: String,
        cells: usize,
        bytes: usize,
        steps: usize,
        times: Vec<Times>,
    ) -> Result<Self, Box<dyn Error>> {
        let [engine, by_hand] = <[Times; 2]>::try_from(times).map_err(|_| "two contenders")?;
        let (engine, by_hand) = (engine.per(steps), by_hand.per(steps));
        Ok(Self { name, cells, bytes, engine, by_hand })
    }

    /// The share of the memory's bandwidth, in bytes a second, that these times reach, in per cent.
    fn share(&self, times: &Times, bandwidth: f64) -> f64 {
        100.0 * (self.cells * self.bytes) as f64 / times.median() / bandwidth
    }

    /// The comparison in a line, beside what the memory can do.
    pub(crate) fn line(&self, bandwidth: f64) -> String {
        let (low, high) = self.engine.spread();
        let (hand_low, hand_high) = self.by_hand.spread();
        format!(
            "{}: engine {:.2} ms a step ({:.2} to {:.2}), {:.0} % of the bandwidth; \
             by hand {:.2} ms ({:.2} to {:.2}), {:.0} %; \
             ratio {:.3}; {:.1} million cells a second",
            self.name,
            self.engine.median() * 1e3,
            low * 1e3,
            high * 1e3,
            self.share(&self.engine, bandwidth),
            self.by_hand.median() * 1e3,
            hand_low * 1e3,
            hand_high * 1e3,
            self.share(&self.by_hand, bandwidth),
            self.engine.median() / self.by_hand.median(),
            self.cells as f64 / self.engine.median() / 1e6,
        )
    }
}
