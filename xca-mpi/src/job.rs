//! The processes of a job: the host, and those that do what it says.

use crate::attendant::Attendant;
use crate::mailbox::Mailbox;
use crate::opened::Opened;
use crate::order::{Beginning, Order};
use crate::place::Place;
use crate::ranks::{Ranks, Shared};
use crate::tag::{Kind, number};
use crate::wire::Wire;
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::thread;
use xca_core::{Engine, Model, Precision};
use xca_parts::{Grid, decline};

/// Makes the engine of a part, which a word names, for a process at this place.
pub type PartEngine<'a> = dyn Fn(&str, &Place) -> Result<Box<dyn Engine>, String> + 'a;

/// The processes that a launcher has started together. The last clone of the process of rank 0 ends them all.
#[derive(Debug, Clone)]
pub struct Job(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    mailbox: Shared,
    /// Takes messages in while the process computes. `None` in a job of one process, and after its end.
    attendant: Option<Attendant>,
    rank: usize,
    size: usize,
    /// Of each process; only the host knows others than itself.
    places: Vec<Place>,
    next: AtomicU32,
    /// Whether the host has said that it needs this process no more.
    stopped: AtomicBool,
}

/// A process that cannot serve.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ServeError {
    /// A message of another build.
    #[error("the host says what this build does not understand; start the same program on all machines")]
    Garbled,
}

/// The exit code of a job whose process has a mistake.
const MISTAKE: i32 = 101;

impl Job {
    /// The job of a wire. The host waits until all other processes have come so far.
    pub fn new(wire: Box<dyn Wire>) -> Self {
        let (rank, size, place) = (wire.rank(), wire.size(), Place::new(&*wire));
        let mailbox = Shared::new(Mailbox::new(wire));
        let mut places = vec![place];
        if rank == 0 {
            // A process that says nothing sensible is found by its greeting, before anything runs.
            let unknown = Place { machine: "unknown".to_owned(), number: 0, threads: 1, is_bound: false };
            let place =
                |from| mailbox.receive(from, 0, Kind::Place).and_then(|bytes| Place::from_bytes(&bytes));
            places.extend((1..size).map(|from| place(from).unwrap_or_else(|| unknown.clone())));
        } else {
            mailbox.lock().send(0, number(0, Kind::Place), places[0].bytes());
        }
        let stopped = AtomicBool::new(rank == 0);
        let attendant = (size > 1).then(|| Attendant::start(mailbox.clone()));
        // The number 0 is that of the job itself.
        Self(Arc::new(Inner { mailbox, attendant, rank, size, places, next: AtomicU32::new(1), stopped }))
    }

    /// The rank of this process.
    pub fn rank(&self) -> usize {
        self.0.rank
    }

    /// The number of processes.
    pub fn size(&self) -> usize {
        self.0.size
    }

    /// Where the processes are: at the host all of them, elsewhere this one.
    pub fn places(&self) -> &[Place] {
        &self.0.places
    }

    /// Has all others make the engines of their parts, and tells of these.
    pub(crate) fn open(&self, part: &str) -> Result<Vec<Opened>, String> {
        self.0.order(&Order::Open(part.to_owned()));
        let replies: Vec<_> = (1..self.size()).map(|from| (from, self.opened(from))).collect();
        let told = |(rank, opened): (usize, Result<Opened, String>)| {
            opened.map_err(|reason| format!("rank {rank} ({}): {reason}", self.places()[rank].machine))
        };
        replies.into_iter().map(told).collect()
    }

    fn opened(&self, from: usize) -> Result<Opened, String> {
        let bytes = self.0.mailbox.receive(from, 0, Kind::Opened).ok_or("it has ended")?;
        Opened::from_bytes(&bytes)
    }

    /// Has all others start their parts of a model; gives the way to them.
    pub(crate) fn start(&self, precision: Precision, grid: Grid, part: &str) -> Ranks {
        let execution = self.0.next.fetch_add(1, Ordering::Relaxed);
        let part = part.to_owned();
        self.0.order(&Order::Start(Beginning { execution, precision, grid, part }));
        Ranks::new(self.0.mailbox.clone(), execution)
    }

    /// Does what the host says, until it ends. Each model that the host starts is made here, too. Where that
    /// fails, the host learns why. A mistake in the program ends all processes.
    ///
    /// # Errors
    /// Where the host is of another build.
    pub fn serve(
        &self,
        engine: &PartEngine<'_>,
        model: &mut dyn FnMut(Precision) -> Result<Model, String>,
    ) -> Result<(), ServeError> {
        catch_unwind(AssertUnwindSafe(|| self.obey(engine, model))).unwrap_or_else(|panic| {
            // The others wait for this process, and would wait on.
            self.0.mailbox.lock().wire.abort(MISTAKE);
            resume_unwind(panic)
        })
    }

    fn obey(
        &self,
        engine: &PartEngine<'_>,
        model: &mut dyn FnMut(Precision) -> Result<Model, String>,
    ) -> Result<(), ServeError> {
        let mut engines: HashMap<String, Arc<dyn Engine>> = HashMap::new();
        thread::scope(|scope| {
            loop {
                let order = self.0.mailbox.receive(0, 0, Kind::Order);
                let order = order.and_then(|bytes| Order::from_bytes(&bytes)).ok_or(ServeError::Garbled)?;
                let beginning = match order {
                    Order::Stop => {
                        self.0.stopped.store(true, Ordering::Relaxed);
                        return Ok(());
                    }
                    Order::Open(part) => {
                        let reply = match engine(&part, &self.places()[0]) {
                            Ok(engine) => {
                                let opened = Opened::new(&*engine);
                                engines.insert(part, Arc::from(engine));
                                opened.bytes()
                            }
                            Err(reason) => Opened::declined(&reason),
                        };
                        self.0.mailbox.lock().send(0, number(0, Kind::Opened), reply);
                        continue;
                    }
                    Order::Start(beginning) => beginning,
                };
                let Beginning { execution, precision, grid, part } = beginning;
                let ranks = Ranks::new(self.0.mailbox.clone(), execution);
                let engine = engines.get(&part).cloned().ok_or_else(|| format!("no engine `{part}` is open"));
                match engine.and_then(|engine| Ok((engine, model(precision)?))) {
                    Err(reason) => decline(&reason, Box::new(ranks)),
                    // Several executions can be there at the same time.
                    Ok((engine, model)) => {
                        scope.spawn(move || {
                            xca_parts::serve(engine, &model, precision, grid, Box::new(ranks));
                        });
                    }
                }
            }
        })
    }
}

impl Inner {
    fn order(&self, order: &Order) {
        let bytes = order.bytes();
        (1..self.size).for_each(|to| self.mailbox.lock().send(to, number(0, Kind::Order), bytes.clone()));
    }
}

impl Drop for Inner {
    fn drop(&mut self) {
        self.attendant = None;
        if self.rank == 0 {
            self.order(&Order::Stop);
        } else if !self.stopped.load(Ordering::Relaxed) {
            // The host counts on this process, and would wait for it.
            self.mailbox.lock().wire.abort(MISTAKE);
            return;
        }
        self.mailbox.lock().finish();
    }
}

#[cfg(test)]
mod tests;
