//! The states of a run that is done for its pictures.

use super::film::{Look, States};
use crate::command::voice::Voice;
use crate::interrupt::Interrupt;
use std::time::Instant;
use xca_core::{Batch, Engine, RunOptions, Simulation};
use xca_record::record::Drawing;
use xca_record::{Failure, Outputs};

/// A run from its beginning, each time that its states are wanted.
pub(super) struct Running<'a> {
    pub(super) engine: &'a dyn Engine,
    pub(super) options: RunOptions,
    pub(super) drawing: &'a Drawing<'a>,
    pub(super) steps: u64,
    /// The steps whose states are drawn.
    pub(super) every: Outputs,
    /// Whether it takes all these steps.
    pub(super) is_known: bool,
    pub(super) interrupt: &'a Interrupt,
    pub(super) voice: Voice,
}

impl States for Running<'_> {
    fn each(&self, doing: &str, look: &mut Look<'_>) -> Result<u64, Failure> {
        let Self { steps: wanted, every, .. } = *self;
        let mut simulation = Simulation::new(self.drawing.model(), self.engine, self.options)?;
        let line = self.voice.line(self.is_known.then_some(wanted));
        line.message(doing);
        let mut batch = Batch::long();
        loop {
            let done = simulation.step_number();
            line.at(done);
            if every.is_due(done) {
                look(done, &self.drawing.seen(&simulation)?)?;
            }
            if done >= wanted || simulation.stop_reason().is_some() || self.interrupt.is_raised() {
                line.finish();
                return Ok(done);
            }
            let next = every.next(done).min(wanted);
            let begin = Instant::now();
            let steps = batch.steps.min(next - done);
            simulation.run(steps)?;
            batch.adapt(steps, begin.elapsed());
        }
    }
}
