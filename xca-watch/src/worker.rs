//! The simulation that is watched, on a thread of its own: a long step must not keep the keys from being
//! heard.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender};
use std::time::{Duration, Instant};
use xca_core::{Batch, Engine, RunOptions, Simulation};
use xca_record::record::{Look, Recorder, Sight};
use xca_record::{Failure, Observable};

/// The next picture comes after this time even if not all steps to it are done.
const PATIENCE: Duration = Duration::from_millis(500);
/// The share of the time that measuring may take.
const MEASURING: u32 = 5;

/// What is to be done, and what is then to be shown.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Order {
    pub(super) advance: Advance,
    pub(super) look: Look,
    /// The scale of colours forgets what there was.
    pub(super) rescales: bool,
}

/// How far the run goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Advance {
    None,
    /// All of these, however long they take.
    Steps(u64),
    /// To the next step that is a multiple of this number, or as far as patience lasts.
    ToMultiple(u64),
    Restart,
}

/// What an order has led to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct News {
    pub(super) step: u64,
    pub(super) sight: Sight,
    pub(super) observables: Vec<Observable>,
    /// The step after which they were measured.
    pub(super) observed: u64,
    /// Why there are no more steps, if there are none.
    pub(super) end: Option<String>,
}

/// What both threads see while an order is carried out.
#[derive(Debug, Default)]
pub(super) struct Shared {
    /// The order is to end after the step that is being done.
    pub(super) halt: AtomicBool,
    /// The steps that are done.
    pub(super) done: AtomicU64,
}

/// Does steps, and tells what there is to see.
pub(super) struct Worker<'a> {
    pub(super) recorder: &'a Recorder,
    pub(super) engine: &'a dyn Engine,
    pub(super) options: RunOptions,
    /// The steps after which the run ends, if it does.
    pub(super) wanted: Option<u64>,
    pub(super) shared: &'a Shared,
}

/// What a run has shown so far.
struct Earlier {
    batch: Batch,
    /// The scale, and the look that it is of.
    scale: Option<(Look, [f64; 2])>,
    measured: Option<Measured>,
}

impl Earlier {
    fn new() -> Self {
        Self { batch: Batch::brief(), scale: None, measured: None }
    }
}

struct Measured {
    observables: Vec<Observable>,
    step: u64,
    end: Instant,
    took: Duration,
}

impl Worker<'_> {
    /// Carries out orders, and answers each, until no more come or one fails.
    pub(super) fn work(
        &self,
        first: Simulation,
        orders: &Receiver<Order>,
        answers: &Sender<Result<News, Failure>>,
    ) {
        let mut simulation = first;
        let mut earlier = Earlier::new();
        while let Ok(order) = orders.recv() {
            if order.advance == Advance::Restart {
                // Both at once may not fit into memory.
                drop(simulation);
                earlier = Earlier::new();
                match Simulation::new(self.recorder.model(), self.engine, self.options) {
                    Ok(new) => simulation = new,
                    Err(error) => {
                        let _ = answers.send(Err(error.into()));
                        return;
                    }
                }
            }
            let answer = self.carry_out(&order, &mut simulation, &mut earlier);
            let is_last = answer.is_err();
            // That no one listens any more is no error.
            if answers.send(answer).is_err() || is_last {
                return;
            }
        }
    }

    fn carry_out(
        &self,
        order: &Order,
        simulation: &mut Simulation,
        earlier: &mut Earlier,
    ) -> Result<News, Failure> {
        let done = simulation.step_number();
        let (to, patience) = match order.advance {
            Advance::None | Advance::Restart => (done, Duration::MAX),
            Advance::Steps(steps) => (done.saturating_add(steps), Duration::MAX),
            Advance::ToMultiple(every) => ((done / every + 1).saturating_mul(every), PATIENCE),
        };
        let to = to.min(self.wanted.unwrap_or(u64::MAX));
        self.advance(simulation, to, patience, &mut earlier.batch)?;
        let step = simulation.step_number();
        self.shared.done.store(step, Ordering::Relaxed);
        let is_patient = !matches!(order.advance, Advance::ToMultiple(_));
        let (observables, observed) = self.measured(simulation, is_patient, &mut earlier.measured)?;
        let sight = self.sight(order, simulation, &mut earlier.scale)?;
        let end = match (simulation.stop_reason(), self.wanted) {
            (Some(reason), _) => Some(format!("ended: {reason}")),
            (None, Some(wanted)) if step >= wanted => Some("ended: all steps are done".to_owned()),
            (None, _) => None,
        };
        Ok(News { step, sight, observables, observed, end })
    }

    fn advance(
        &self,
        simulation: &mut Simulation,
        to: u64,
        patience: Duration,
        batch: &mut Batch,
    ) -> Result<(), Failure> {
        let begin = Instant::now();
        while simulation.step_number() < to
            && simulation.stop_reason().is_none()
            && !self.shared.halt.load(Ordering::Relaxed)
            && begin.elapsed() < patience
        {
            let steps = batch.steps.min(to - simulation.step_number());
            let start = Instant::now();
            simulation.run(steps)?;
            batch.adapt(steps, start.elapsed());
            self.shared.done.store(simulation.step_number(), Ordering::Relaxed);
        }
        Ok(())
    }

    /// The observables and their step: of an earlier one where measuring again would take too large a share
    /// of the time.
    fn measured(
        &self,
        simulation: &mut Simulation,
        is_patient: bool,
        last: &mut Option<Measured>,
    ) -> Result<(Vec<Observable>, u64), Failure> {
        let step = simulation.step_number();
        let is_due = |last: &Measured| {
            last.step != step && (is_patient || last.end.elapsed() >= last.took * MEASURING)
        };
        if last.as_ref().is_none_or(is_due) {
            let begin = Instant::now();
            let observables = self.recorder.measure(simulation)?;
            let (end, took) = (Instant::now(), begin.elapsed());
            *last = Some(Measured { observables, step, end, took });
        }
        Ok(last.as_ref().map(|last| (last.observables.clone(), last.step)).unwrap_or_default())
    }

    fn sight(
        &self,
        order: &Order,
        simulation: &Simulation,
        scale: &mut Option<(Look, [f64; 2])>,
    ) -> Result<Sight, Failure> {
        // All layers have the same scale.
        let of_scale = Look { layer: None, axis: None, ..order.look.clone() };
        let earlier = scale.as_ref().filter(|(look, _)| *look == of_scale && !order.rescales);
        let earlier = earlier.map(|(_, range)| *range);
        // The next substate may be one of items, which have no layers.
        let drawing = self.recorder.sighting(&order.look).or_else(|_| self.recorder.sighting(&of_scale))?;
        let sight = drawing.sight(simulation, earlier)?.ok_or("there is nothing to see")?;
        *scale = sight.range.map(|range| (of_scale, range));
        Ok(sight)
    }
}
