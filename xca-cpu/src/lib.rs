//! The parallel CPU engine.
//!
//! It runs the rows of the cellular space on all cores. The bits are those of the reference engine, at any
//! number of threads.
//! - Substates of cells are planes with a halo as wide as the neighbourhood. A neighbour is therefore a
//!   constant offset.
//! - Populations are compact: items are stored cell after cell, and empty rows cost nothing.
//! - Processes that do not affect each other run together, row by row, while a row is in the cache.
//! - Consecutive steps can follow each other at a distance of a few rows, if that is faster.
//! - A substate that is read only at the centre is written in place. Any other is written to a second buffer.

mod activity;
mod arrays;
mod blocks;
mod choices;
mod crossing;
mod dense;
mod edges;
mod execution;
mod ghosts;
mod group;
mod layout;
mod listing;
mod lists;
mod measurement;
mod memory;
mod migration;
mod motion;
mod part;
mod population;
mod reductions;
mod renewal;
mod row_counts;
mod rows;
mod stages;
mod stride;
mod threads;
mod tiles;
mod upkeep;

use choices::{Choices, LeaveOut};
use execution::CpuExecution;
use layout::Layout;
use std::fmt;
use threads::Threads;
use xca_core::engine::{Border, Engine, Execution, Part, StartError};
use xca_core::{Model, Precision};

/// The engine for all cores.
#[derive(Clone)]
pub struct Cpu {
    own: Threads,
    choices: Choices,
}

impl Cpu {
    /// The largest number of threads. More threads than cores only cost memory.
    pub const MOST_THREADS: usize = 1024;

    /// Creates an engine with one thread for each available core. The environment variable
    /// `RAYON_NUM_THREADS` overrides the number.
    ///
    /// # Errors
    /// If the variable asks for more than [`Cpu::MOST_THREADS`] threads, or if the system cannot start the
    /// threads.
    pub fn new() -> Result<Self, CpuError> {
        let chosen = std::env::var("RAYON_NUM_THREADS").ok().and_then(|text| text.parse().ok());
        match chosen.filter(|threads| *threads > 0) {
            Some(threads) => Self::with_threads(threads),
            None => {
                let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
                Self::with_threads(cores.min(Self::MOST_THREADS))
            }
        }
    }

    /// Creates an engine with this number of threads.
    ///
    /// # Errors
    /// For 0 threads, for more than [`Cpu::MOST_THREADS`], and if the system cannot start the threads.
    pub fn with_threads(threads: usize) -> Result<Self, CpuError> {
        match threads {
            0 => return Err(CpuError::NoThreads),
            threads if threads > Self::MOST_THREADS => return Err(CpuError::TooManyThreads { threads }),
            _ => {}
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|number| format!("xca-cpu-{number}"))
            .build()
            .map_err(|source| CpuError::Threads { threads, source })?;
        Ok(Self { own: Threads::new(pool), choices: Choices::default() })
    }

    /// Sets the skin of neighbour lists, in search radii, in place of the engine's choice. For tests: it
    /// changes the time of a search, but no result.
    #[doc(hidden)]
    #[must_use]
    pub fn with_skin(self, radii: f64) -> Self {
        Self { choices: Choices { skin: Some(radii), ..self.choices }, ..self }
    }

    /// Sets the number of cells in a tile, at least one. Tiles in which nothing can change are always
    /// skipped. For tests: it changes the time of a step, but no result.
    #[doc(hidden)]
    #[must_use]
    pub fn with_tiles(self, cells: std::num::NonZeroUsize) -> Self {
        let leave_out = LeaveOut::Always(cells.get());
        Self { choices: Choices { leave_out, ..self.choices }, ..self }
    }

    /// Sets the number of steps done together, at least one, if the space has room for them. For tests: it
    /// changes the time of a step, but no result.
    #[doc(hidden)]
    #[must_use]
    pub fn with_stride(self, steps: std::num::NonZeroU64) -> Self {
        Self { choices: Choices { stride: Some(steps.get()), ..self.choices }, ..self }
    }

    /// Sets the number of rows in the columns for steps done together, if the space allows columns. For
    /// tests: it changes the time of a step, but no result.
    #[doc(hidden)]
    #[must_use]
    pub fn with_columns(self, rows: std::num::NonZeroUsize) -> Self {
        Self { choices: Choices { column: Some(rows.get()), ..self.choices }, ..self }
    }

    /// Updates all cells in each step. For benchmarks: it changes the time of a step, but no result.
    #[doc(hidden)]
    #[must_use]
    pub fn without_tiles(self) -> Self {
        Self { choices: Choices { leave_out: LeaveOut::Never, ..self.choices }, ..self }
    }
}

impl fmt::Debug for Cpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Cpu").field("threads", &self.threads()).finish()
    }
}

/// An engine that cannot be created.
#[derive(Debug, thiserror::Error)]
pub enum CpuError {
    /// The number of threads is 0.
    #[error("the cpu engine needs at least 1 thread")]
    NoThreads,
    /// The number of threads is too large.
    #[error("{threads} threads are too many for the cpu engine; take at most {}", Cpu::MOST_THREADS)]
    TooManyThreads {
        /// The requested number.
        threads: usize,
    },
    /// The system cannot start the threads.
    #[error("the cpu engine could not start {threads} threads")]
    Threads {
        /// The requested number.
        threads: usize,
        /// The system's error.
        source: rayon::ThreadPoolBuildError,
    },
}

impl Engine for Cpu {
    fn name(&self) -> &str {
        "cpu"
    }

    fn threads(&self) -> usize {
        self.own.count()
    }

    fn least_memory(&self, model: &Model, precision: Precision) -> u128 {
        memory::least_memory(model, &Layout::new(model.geometry()), precision)
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        Ok(Box::new(CpuExecution::new(model, precision, self.own.clone(), self.choices, None)?))
    }

    fn start_part(
        &self,
        model: &Model,
        precision: Precision,
        part: &Part,
        border: Box<dyn Border>,
    ) -> Result<Box<dyn Execution>, StartError> {
        part.check(model.geometry())?;
        let shares = *part != Part::whole(model.geometry());
        let shared = shares.then(|| (part.clone(), border));
        Ok(Box::new(CpuExecution::new(model, precision, self.own.clone(), self.choices, shared)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_threads_are_checked_before_any_is_started() {
        assert!(matches!(Cpu::with_threads(0), Err(CpuError::NoThreads)));
        for threads in [Cpu::MOST_THREADS + 1, usize::MAX] {
            let error = Cpu::with_threads(threads).unwrap_err().to_string();
            assert!(error.contains(&format!("{threads} threads are too many")), "{error}");
        }
    }
}
