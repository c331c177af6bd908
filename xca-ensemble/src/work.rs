//! Members side by side.

use super::member::{End, Finished, Member};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};
use xca_core::{Batch, Engine, Precision, RunOptions, Simulation};
use xca_record::Failure;
use xca_record::SetUp;
use xca_record::record::Recorder;
use xca_record::recording::check_finite;

/// How often the calling thread looks whether it should end.
const PATIENCE: Duration = Duration::from_millis(50);

/// How members are run.
pub(super) struct Work<'a> {
    pub(super) jobs: usize,
    pub(super) precision: Precision,
    pub(super) steps: Option<u64>,
    pub(super) engine: &'a (dyn Fn() -> Result<Box<dyn Engine>, Failure> + Sync),
}

/// A member that can be run.
struct Order {
    member: Member,
    set_up: SetUp,
}

/// What a worker says.
enum News {
    /// It waits for an order.
    Ready(Sender<Order>),
    /// A member has come to its end.
    Ended(Box<Finished>),
}

impl Work<'_> {
    /// Runs these members. `event` is called on this thread: with a member that has ended, or with nothing
    /// every now and then; it says whether to go on.
    pub(super) fn run(
        &self,
        members: &mut dyn Iterator<Item = Member>,
        set_up: &mut dyn FnMut(&Member) -> Result<SetUp, Failure>,
        event: &mut dyn FnMut(Option<Finished>) -> bool,
    ) {
        let stop = AtomicBool::new(false);
        let (send, news) = mpsc::channel();
        thread::scope(|scope| {
            for _ in 0..self.jobs {
                let (send, stop) = (send.clone(), &stop);
                scope.spawn(move || self.worker(&send, stop));
            }
            drop(send);
            direct(&news, members, set_up, event, &stop);
        });
    }

    /// Does what it is told, until there is nothing more.
    fn worker(&self, news: &Sender<News>, stop: &AtomicBool) {
        let engine = (self.engine)();
        loop {
            let (send, orders) = mpsc::channel();
            if news.send(News::Ready(send)).is_err() {
                return;
            }
            let Ok(Order { member, set_up }) = orders.recv() else { return };
            let finished = match &engine {
                Ok(engine) => self.member(member, set_up, &**engine, stop),
                Err(error) => Some(Finished::failed(member, 0, error)),
            };
            // A member that was given up is told to no one.
            if let Some(finished) = finished
                && news.send(News::Ended(Box::new(finished))).is_err()
            {
                return;
            }
        }
    }

    /// Runs a member; nothing if it is given up. What panics is a member that failed.
    fn member(
        &self,
        member: Member,
        set_up: SetUp,
        engine: &dyn Engine,
        stop: &AtomicBool,
    ) -> Option<Finished> {
        let mut steps = 0;
        let run = || self.observe(&member, set_up, engine, stop, &mut steps);
        match catch_unwind(AssertUnwindSafe(run)) {
            Ok(Ok(finished)) => finished,
            Ok(Err(error)) => Some(Finished::failed(member, steps, error)),
            Err(_) => Some(Finished::failed(member, steps, "it panicked")),
        }
    }

    fn observe(
        &self,
        member: &Member,
        mut set_up: SetUp,
        engine: &dyn Engine,
        stop: &AtomicBool,
        done: &mut u64,
    ) -> Result<Option<Finished>, Failure> {
        for assigned in &member.parameters {
            set_up.model.set_parameter(&assigned.parameter, &assigned.value)?;
        }
        let wanted = self.steps.unwrap_or(set_up.steps);
        let recorder = Recorder::new(set_up)?;
        let options = RunOptions { precision: self.precision, seed: member.seed };
        let mut simulation = Simulation::new(recorder.model(), engine, options)?;
        let mut batch = Batch::long();
        while simulation.step_number() < wanted && simulation.stop_reason().is_none() {
            if stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let begin = Instant::now();
            let steps = batch.steps.min(wanted - simulation.step_number());
            let result = simulation.run(steps);
            *done = simulation.step_number();
            result?;
            batch.adapt(steps, begin.elapsed());
        }
        simulation.finish()?;
        check_finite(&simulation)?;
        let observables = recorder.measure(&mut simulation)?;
        let end = simulation.stop_reason().map_or(End::Done, |reason| End::Stopped(reason.to_owned()));
        Ok(Some(Finished { member: member.clone(), end, steps: simulation.step_number(), observables }))
    }
}

/// Gives orders to the workers, and passes on what they say.
fn direct(
    news: &Receiver<News>,
    members: &mut dyn Iterator<Item = Member>,
    set_up: &mut dyn FnMut(&Member) -> Result<SetUp, Failure>,
    event: &mut dyn FnMut(Option<Finished>) -> bool,
    stop: &AtomicBool,
) {
    loop {
        let goes_on = match news.recv_timeout(PATIENCE) {
            Ok(News::Ended(finished)) => event(Some(*finished)),
            Ok(News::Ready(worker)) => {
                // Without an order, the worker ends.
                if !stop.load(Ordering::Relaxed) && !order(&worker, members, set_up, event) {
                    stop.store(true, Ordering::Relaxed);
                }
                true
            }
            Err(RecvTimeoutError::Timeout) => event(None),
            Err(RecvTimeoutError::Disconnected) => return,
        };
        if !goes_on {
            stop.store(true, Ordering::Relaxed);
        }
    }
}

/// Gives a worker the next member that can be made, if there is one. Those that cannot have failed.
fn order(
    worker: &Sender<Order>,
    members: &mut dyn Iterator<Item = Member>,
    set_up: &mut dyn FnMut(&Member) -> Result<SetUp, Failure>,
    event: &mut dyn FnMut(Option<Finished>) -> bool,
) -> bool {
    for member in members {
        match set_up(&member) {
            Ok(set_up) => {
                let _ = worker.send(Order { member, set_up });
                return true;
            }
            Err(error) => {
                if !event(Some(Finished::failed(member, 0, error))) {
                    return false;
                }
            }
        }
    }
    true
}
