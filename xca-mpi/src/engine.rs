//! The engine of a job, for its host.

use crate::job::{Job, PartEngine};
use std::sync::Arc;
use xca_core::engine::{Engine, Execution, StartError};
use xca_core::{Model, Precision};
use xca_parts::{Balance, Grid, host};

/// The name of the engine.
const NAME: &str = "mpi";

/// An engine whose parts are the processes of a job. Only the process of rank 0 makes one.
#[derive(Debug)]
pub struct Mpi {
    job: Job,
    /// What runs the part of this process.
    own: Arc<dyn Engine>,
    threads: Option<usize>,
    /// The parts along the axes, where they are chosen.
    grid: Option<Grid>,
    balance: Balance,
}

impl Mpi {
    /// The engine of a job, each of whose parts has so many threads, or as many as its process has cores for.
    ///
    /// # Errors
    /// Where the engine of the own part cannot be made.
    pub fn new(job: Job, engine: &PartEngine<'_>, threads: Option<usize>) -> Result<Self, String> {
        let own = threads.or(job.places().first().map(|place| place.threads)).unwrap_or(1);
        Ok(Self { own: Arc::from(engine(own)?), job, threads, grid: None, balance: Balance::default() })
    }

    /// The same engine with these numbers of parts along y and z, one part for each process.
    pub fn in_grid(self, grid: Grid) -> Self {
        Self { grid: Some(grid), ..self }
    }

    /// The same engine with another rule when the bounds of parts follow the work.
    pub fn with_balance(self, balance: Balance) -> Self {
        Self { balance, ..self }
    }

    fn threads_of_parts(&self) -> impl Iterator<Item = usize> {
        self.job.places().iter().map(|place| self.threads.unwrap_or(place.threads))
    }
}

impl Engine for Mpi {
    fn name(&self) -> &str {
        NAME
    }

    fn threads(&self) -> usize {
        self.threads_of_parts().sum()
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        let rank = |(rank, (place, threads)): (usize, (&crate::Place, usize))| {
            format!(
                "{rank}: {}, {threads} {}",
                place.machine,
                if threads == 1 { "thread" } else { "threads" }
            )
        };
        let ranks = self.job.places().iter().zip(self.threads_of_parts()).enumerate().map(rank);
        let mut facts = vec![
            ("parts", self.grid.map_or_else(|| self.job.size().to_string(), |grid| grid.to_string())),
            ("part_engine", self.own.name().to_owned()),
            ("ranks", ranks.collect::<Vec<_>>().join("; ")),
        ];
        facts.extend(self.own.facts());
        facts
    }

    fn note(&self) -> Option<String> {
        let is_bound = self.threads.is_none() && self.job.places().iter().any(|place| place.is_bound);
        is_bound.then(|| {
            "the launcher leaves a process fewer cores than its share; `mpirun --bind-to none` gives it more"
                .to_owned()
        })
    }

    fn least_memory(&self, model: &Model, precision: Precision) -> u128 {
        // The host gathers the whole state for each output.
        self.own.least_memory(model, precision)
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let (geometry, size) = (model.geometry(), self.job.size());
        let grid = match self.grid {
            None => Grid::into_parts(geometry, size, NAME)?,
            Some(grid) => grid.check(geometry, NAME).map(|()| grid)?,
        };
        if grid.count() != size {
            let reason = format!("{grid} are {} parts, but the job has {size} processes", grid.count());
            return Err(StartError::NoParts { engine: NAME.to_owned(), reason });
        }
        let ranks = self.job.start(precision, grid, self.threads);
        host(Arc::clone(&self.own), model, precision, grid, self.balance, Box::new(ranks))
    }
}
