//! The engine beside a loop by hand.

use crate::timing::Times;
use std::error::Error;
use xca_core::engine::Figure;

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
    /// Seconds a step of the engine when it does one after the other.
    step_by_step: Option<Times>,
    /// The mean number of steps that the engine has done together, and the share of cells it has worked on.
    together: f64,
    share_of_cells: f64,
}

impl Comparison {
    /// Of the times of so many steps: first the engine's, then those of the loop by hand, and then, if they
    /// were taken, those of the engine that does one step after the other. A step reads and writes `bytes` of
    /// each cell.
    pub(crate) fn new(
        name: String,
        cells: usize,
        bytes: usize,
        steps: usize,
        times: Vec<Times>,
    ) -> Result<Self, Box<dyn Error>> {
        let mut times = times.iter().map(|times| times.per(steps));
        let engine = times.next().ok_or("the engine is not there")?;
        let by_hand = times.next().ok_or("the loop by hand is not there")?;
        let (step_by_step, together, share_of_cells) = (times.next(), 1.0, 1.0);
        Ok(Self { name, cells, bytes, engine, by_hand, step_by_step, together, share_of_cells })
    }

    /// With what the engine reports of its work.
    pub(crate) fn with_figures(self, figures: &[Figure]) -> Self {
        let value = |name: &str| figures.iter().find(|figure| figure.name == name).map(|figure| figure.value);
        let together = value("steps_together").unwrap_or(1.0);
        Self { together, share_of_cells: value("share_of_cells_worked_on").unwrap_or(1.0), ..self }
    }

    /// The share of the memory's bandwidth, in bytes a second, that these times reach, in per cent.
    fn share(&self, times: &Times, bandwidth: f64) -> f64 {
        100.0 * (self.cells * self.bytes) as f64 / times.median() / bandwidth
    }

    /// The comparison in a line, beside what the memory can do.
    pub(crate) fn line(&self, bandwidth: f64) -> String {
        let (low, high) = self.engine.spread();
        let (hand_low, hand_high) = self.by_hand.spread();
        let step_by_step = self.step_by_step.as_ref().map(|times| {
            let (low, high) = times.spread();
            let ratio = self.engine.median() / times.median();
            let [median, low, high] = [times.median(), low, high].map(|seconds| seconds * 1e3);
            format!("; step by step {median:.2} ms ({low:.2} to {high:.2}), ratio {ratio:.3}")
        });
        format!(
            "{}: engine {:.2} ms a step ({:.2} to {:.2}), {:.0} % of the bandwidth; \
             by hand {:.2} ms ({:.2} to {:.2}), {:.0} %; \
             ratio {:.3}; {:.1} million cells a second; {:.0} % of the cells worked on; \
             {:.1} steps together{}",
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
            100.0 * self.share_of_cells,
            self.together,
            step_by_step.unwrap_or_default(),
        )
    }
}
