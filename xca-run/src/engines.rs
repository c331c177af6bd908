//! The engines that a program can choose from.

use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;
use xca_core::{Engine, Reference};
use xca_cpu::{Cpu, CpuError};
#[cfg(feature = "gpu")]
use xca_gpu::{AdapterChoice, Gpu, GpuError, GpuOptions};

/// The most threads that can be asked for; many more than cores only cost memory.
pub const MOST_THREADS: usize = Cpu::MOST_THREADS;

/// An engine by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, ValueEnum)]
#[non_exhaustive]
pub enum EngineName {
    /// All cores, or as many threads as --threads says
    #[default]
    Cpu,
    /// A graphics adapter, or software Vulkan where there is none
    Gpu,
    /// Serial and plain: the oracle of the others
    Reference,
}

/// Float arithmetic of the gpu engine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Arithmetic {
    /// Strict where the adapter proves it, else relaxed.
    #[default]
    Best,
    /// The bits of the other engines; refused where the adapter cannot prove it.
    Strict,
    /// The driver's own: it may contract and reorder.
    Relaxed,
}

/// A word that names no arithmetic.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no arithmetic; use best, strict or relaxed")]
pub struct UnknownArithmetic(String);

impl FromStr for Arithmetic {
    type Err = UnknownArithmetic;

    fn from_str(text: &str) -> Result<Self, UnknownArithmetic> {
        match text {
            "best" => Ok(Self::Best),
            "strict" => Ok(Self::Strict),
            "relaxed" => Ok(Self::Relaxed),
            other => Err(UnknownArithmetic(other.to_owned())),
        }
    }
}

#[cfg(feature = "gpu")]
impl From<Arithmetic> for xca_gpu::Arithmetic {
    fn from(arithmetic: Arithmetic) -> Self {
        match arithmetic {
            Arithmetic::Best => Self::Best,
            Arithmetic::Strict => Self::Strict,
            Arithmetic::Relaxed => Self::Relaxed,
        }
    }
}

/// A part that the program was built without.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "this program was built without the feature `{feature}`; build it with \
     `cargo run --release --features xca/{feature}`"
)]
pub struct MissingFeature {
    feature: &'static str,
}

#[cfg(not(feature = "gpu"))]
impl MissingFeature {
    /// The engine for graphics adapters.
    pub(crate) const GPU: Self = Self { feature: "gpu" };
}

#[cfg(not(feature = "terminal"))]
impl MissingFeature {
    /// The subcommand `watch`.
    pub(crate) const TERMINAL: Self = Self { feature: "terminal" };
}

/// An engine that cannot be had.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// Threads for a serial engine.
    #[error(
        "the reference engine is serial and cannot use {0} threads; leave --threads away, or take --engine cpu"
    )]
    Serial(usize),
    /// Threads for an engine that has none.
    #[error("the gpu engine has no threads to choose; leave --threads away, or take --engine cpu")]
    Threadless,
    /// A device for an engine that has none.
    #[error("--adapter and --arithmetic are for --engine gpu, not for the {0} engine")]
    Deviceless(EngineName),
    /// The engine says why.
    #[error(transparent)]
    Cpu(#[from] CpuError),
    /// The engine says why.
    #[cfg(feature = "gpu")]
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The program was built without the engine.
    #[error(transparent)]
    Missing(#[from] MissingFeature),
}

/// How an engine is made; what is not given is the engine's own choice.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct EngineOptions {
    /// How many threads, for the engine that uses them.
    pub threads: Option<usize>,
    /// The number of an adapter, or a part of its name, for the engine that uses one.
    pub adapter: Option<String>,
    /// How the GPU does float arithmetic.
    pub arithmetic: Option<Arithmetic>,
}

impl EngineName {
    /// How many threads the engine uses where many of them work side by side; none where it has none.
    pub(crate) fn default_threads(self) -> Option<usize> {
        (self == Self::Cpu).then_some(1)
    }

    /// The engine.
    ///
    /// # Errors
    /// Where the engine has nothing of what is asked for, or the system does not give it.
    pub fn engine(self, options: &EngineOptions) -> Result<Box<dyn Engine>, EngineError> {
        let EngineOptions { threads, adapter, arithmetic } = options;
        if self != Self::Gpu && (adapter.is_some() || arithmetic.is_some()) {
            return Err(EngineError::Deviceless(self));
        }
        match (self, *threads) {
            (Self::Reference, None | Some(1)) => Ok(Box::new(Reference)),
            (Self::Reference, Some(threads)) => Err(EngineError::Serial(threads)),
            (Self::Cpu, None) => Ok(Box::new(Cpu::new()?)),
            (Self::Cpu, Some(threads)) => Ok(Box::new(Cpu::with_threads(threads)?)),
            (Self::Gpu, Some(_)) => Err(EngineError::Threadless),
            (Self::Gpu, None) => gpu(options),
        }
    }
}

#[cfg(feature = "gpu")]
fn gpu(options: &EngineOptions) -> Result<Box<dyn Engine>, EngineError> {
    let adapter = options.adapter.as_deref().map(AdapterChoice::from).unwrap_or_default();
    let arithmetic = options.arithmetic.unwrap_or_default().into();
    Ok(Box::new(Gpu::new(&GpuOptions { adapter, arithmetic, ..GpuOptions::default() })?))
}

#[cfg(not(feature = "gpu"))]
fn gpu(_options: &EngineOptions) -> Result<Box<dyn Engine>, EngineError> {
    Err(MissingFeature::GPU.into())
}

impl fmt::Display for EngineName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cpu => "cpu",
            Self::Gpu => "gpu",
            Self::Reference => "reference",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_threads(threads: Option<usize>) -> EngineOptions {
        EngineOptions { threads, ..EngineOptions::default() }
    }

    #[test]
    fn engines_know_how_many_threads_they_can_use() {
        assert_eq!(EngineName::Cpu.engine(&with_threads(Some(3))).unwrap().threads(), 3);
        assert_eq!(EngineName::Reference.engine(&with_threads(None)).unwrap().threads(), 1);
        let error = EngineName::Reference.engine(&with_threads(Some(2))).unwrap_err().to_string();
        assert!(error.contains("serial and cannot use 2 threads"), "{error}");
        let error = EngineName::Gpu.engine(&with_threads(Some(2))).unwrap_err().to_string();
        assert!(error.contains("no threads to choose"), "{error}");
    }

    #[test]
    fn adapters_are_for_the_gpu_engine() {
        let options = EngineOptions { adapter: Some("0".to_owned()), ..EngineOptions::default() };
        let error = EngineName::Cpu.engine(&options).unwrap_err().to_string();
        assert!(error.contains("not for the cpu engine"), "{error}");
        let options = EngineOptions { adapter: Some("no such adapter".to_owned()), ..options };
        let error = EngineName::Gpu.engine(&options).unwrap_err().to_string();
        let wanted = if cfg!(feature = "gpu") {
            "no adapter is `no such adapter`; this machine has 0: "
        } else {
            "built without the feature `gpu`; build it with `cargo run --release --features xca/gpu`"
        };
        assert!(error.contains(wanted), "{error}");
    }

    #[test]
    fn names_are_those_of_the_engines() {
        for name in EngineName::value_variants() {
            if !cfg!(feature = "gpu") && *name == EngineName::Gpu {
                continue;
            }
            assert_eq!(name.engine(&with_threads(None)).unwrap().name(), name.to_string());
        }
    }
}
