//! The engine of a job, for its host.

use crate::job::{Job, PartEngine};
use crate::opened::Opened;
use crate::place::Place;
use std::sync::Arc;
use xca_core::engine::{Engine, Execution, StartError};
use xca_core::{Model, Precision};
use xca_parts::{Balance, Grid, facts_of_parts, host};

/// The name of the engine.
const NAME: &str = "mpi";

/// An engine whose parts are the processes of a job. Only the process of rank 0 makes one.
#[derive(Debug)]
pub struct Mpi {
    job: Job,
    /// What runs the part of this process.
    own: Arc<dyn Engine>,
    /// The word that names the engine of each part.
    part: String,
    /// What the processes say of their engines, by rank.
    opened: Vec<Opened>,
    /// The parts along the axes, where they are chosen.
    grid: Option<Grid>,
    balance: Balance,
}

impl Mpi {
    /// The engine of a job, each of whose parts runs on the engine that this word names.
    ///
    /// # Errors
    /// Where the engine of a part cannot be made.
    pub fn new(job: Job, engine: &PartEngine<'_>, part: &str) -> Result<Self, String> {
        let own: Arc<dyn Engine> = Arc::from(engine(part, &job.places()[0])?);
        let opened = std::iter::once(Opened::new(&*own)).chain(job.open(part)?).collect();
        Ok(Self { own, job, part: part.to_owned(), opened, grid: None, balance: Balance::default() })
    }

    /// The same engine with these numbers of parts along y and z, one part for each process.
    pub fn in_grid(self, grid: impl Into<Option<Grid>>) -> Self {
        Self { grid: grid.into().or(self.grid), ..self }
    }

    /// The same engine with another rule when the bounds of parts follow the work.
    pub fn with_balance(self, balance: Balance) -> Self {
        Self { balance, ..self }
    }
}

impl Engine for Mpi {
    fn name(&self) -> &str {
        NAME
    }

    fn threads(&self) -> usize {
        self.opened.iter().map(|opened| opened.threads).sum()
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        let rank = |(rank, (place, opened)): (usize, (&Place, &Opened))| {
            let threads = opened.threads;
            let word = if threads == 1 { "thread" } else { "threads" };
            format!("{rank}: {}, {threads} {word}", place.machine)
        };
        let ranks = self.job.places().iter().zip(&self.opened).enumerate().map(rank);
        let mut facts = vec![
            ("parts", self.grid.map_or_else(|| self.job.size().to_string(), |grid| grid.to_string())),
            ("part_engine", self.own.name().to_owned()),
            ("ranks", ranks.collect::<Vec<_>>().join("; ")),
        ];
        let names: Vec<&'static str> = self.own.facts().into_iter().map(|(name, _)| name).collect();
        let all: Vec<_> = self.opened.iter().map(|opened| opened.facts(&names)).collect();
        facts.extend(facts_of_parts(&all));
        facts
    }

    fn note(&self) -> Option<String> {
        // Where the number of threads stands in the word, it is chosen.
        let is_bound = !self.part.contains(':') && self.job.places().iter().any(|place| place.is_bound);
        let bound = is_bound.then(|| {
            "the launcher leaves a process fewer cores than its share; `mpirun --bind-to none` gives it more"
                .to_owned()
        });
        let notes: Vec<String> = bound.into_iter().chain(self.own.note()).collect();
        (!notes.is_empty()).then(|| notes.join("; "))
    }

    fn least_memory(&self, model: &Model, precision: Precision) -> u128 {
        // Programs compare it with the memory of the host's machine, which has the cells of the processes
        // on it.
        let places = self.job.places();
        let here = places.iter().filter(|place| place.machine == places[0].machine).count();
        self.own.least_memory(model, precision) * here as u128 / places.len() as u128
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let size = self.job.size();
        let grid = match self.grid {
            None => Grid::into_parts(model, size, NAME)?,
            Some(grid) => grid.check(model.geometry(), NAME).map(|()| grid)?,
        };
        if grid.count() != size {
            let reason = format!("{grid} are {} parts, but the job has {size} processes", grid.count());
            return Err(StartError::NoParts { engine: NAME.to_owned(), reason });
        }
        let ranks = self.job.start(precision, grid, &self.part);
        host(Arc::clone(&self.own), model, precision, grid, self.balance, Box::new(ranks))
    }
}
