//! The engines that a program can choose from.

use clap::ValueEnum;
use std::fmt;
use xca_core::{Engine, Reference};
use xca_cpu::{Cpu, CpuError};

/// The most threads that can be asked for; many more than cores only cost memory.
pub const MOST_THREADS: usize = 1024;

/// An engine by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, ValueEnum)]
pub enum EngineName {
    /// All cores, or as many threads as --threads says
    #[default]
    Cpu,
    /// Serial and plain: the oracle of the others
    Reference,
}

/// An engine that cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// Threads for a serial engine.
    #[error(
        "the reference engine is serial and cannot use {0} threads; leave --threads away, or take --engine cpu"
    )]
    Serial(usize),
    /// The engine says why.
    #[error(transparent)]
    Cpu(#[from] CpuError),
}

impl EngineName {
    /// The engine, with so many threads or with one for each core.
    ///
    /// # Errors
    /// Where the engine cannot use so many threads, or the system does not give them.
    pub fn with_threads(self, threads: Option<usize>) -> Result<Box<dyn Engine>, EngineError> {
        match (self, threads) {
            (Self::Reference, None | Some(1)) => Ok(Box::new(Reference)),
            (Self::Reference, Some(threads)) => Err(EngineError::Serial(threads)),
            (Self::Cpu, None) => Ok(Box::new(Cpu::new()?)),
            (Self::Cpu, Some(threads)) => Ok(Box::new(Cpu::with_threads(threads)?)),
        }
    }
}

impl fmt::Display for EngineName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cpu => "cpu",
            Self::Reference => "reference",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn engines_know_how_many_threads_they_can_use() {
        assert_eq!(EngineName::Cpu.with_threads(Some(3)).unwrap().threads(), 3);
        assert_eq!(EngineName::Reference.with_threads(None).unwrap().threads(), 1);
        let error = EngineName::Reference.with_threads(Some(2)).unwrap_err().to_string();
        assert!(error.contains("serial and cannot use 2 threads"), "{error}");
    }

    #[test]
    fn names_are_those_of_the_engines() {
        for name in EngineName::value_variants() {
            assert_eq!(name.with_threads(Some(1)).unwrap().name(), name.to_string());
        }
    }
}
