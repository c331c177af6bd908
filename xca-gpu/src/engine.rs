//! The engine as a program chooses it.

use crate::device::{Adapter, AdapterChoice, Device};
use crate::error::GpuError;
use crate::execution::GpuExecution;
use crate::program::Manner;
use crate::proof;
use std::fmt;
use std::sync::Arc;
use xca_core::engine::{Engine, Execution, StartError};
use xca_core::{Model, Precision};

/// How float arithmetic is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Arithmetic {
    /// Strict where the adapter proves it, else relaxed.
    #[default]
    Best,
    /// With the bits of the reference engine; refused where the adapter cannot prove it.
    Strict,
    /// As the driver likes: it may contract and reorder.
    Relaxed,
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Best => "best",
            Self::Strict => "strict",
            Self::Relaxed => "relaxed",
        })
    }
}

/// What is asked of the engine.
#[derive(Debug, Clone, Default)]
pub struct GpuOptions {
    /// Which adapter.
    pub adapter: AdapterChoice,
    /// How float arithmetic is done.
    pub arithmetic: Arithmetic,
}

/// The GPU engine: an open adapter.
#[derive(Debug, Clone)]
pub struct Gpu {
    device: Arc<Device>,
    /// Why arithmetic is relaxed, where it is.
    relaxed: Option<String>,
}

impl Gpu {
    /// Opens an adapter, and has it prove strict arithmetic.
    ///
    /// # Errors
    /// Where no adapter is found or none is meant, where it cannot be opened, or cannot do what is asked.
    pub fn new(options: &GpuOptions) -> Result<Self, GpuError> {
        let device = Arc::new(Device::open(&options.adapter)?);
        let relaxed = match options.arithmetic {
            Arithmetic::Relaxed => Some("it was asked for".to_owned()),
            Arithmetic::Best | Arithmetic::Strict => proof::of_strictness(&device).err(),
        };
        match (&relaxed, options.arithmetic) {
            (Some(reason), Arithmetic::Strict) => {
                Err(GpuError::NotStrict { adapter: device.adapter().to_string(), reason: reason.clone() })
            }
            _ => Ok(Self { device, relaxed }),
        }
    }

    /// The adapter.
    pub fn adapter(&self) -> &Adapter {
        self.device.adapter()
    }

    /// Whether float arithmetic has the bits of the reference engine.
    pub fn is_strict(&self) -> bool {
        self.relaxed.is_none()
    }

    /// Why arithmetic is relaxed, where it is.
    pub fn why_relaxed(&self) -> Option<&str> {
        self.relaxed.as_deref()
    }
}

impl Engine for Gpu {
    fn name(&self) -> &str {
        "gpu"
    }

    fn threads(&self) -> usize {
        1
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let manner = Manner { precision, strict: self.is_strict() };
        match GpuExecution::new(model, manner, Arc::clone(&self.device)) {
            Ok(execution) => Ok(Box::new(execution)),
            Err(error) => Err(StartError::Other {
                engine: "gpu".to_owned(),
                reason: format!("{error} (adapter: {})", self.adapter()),
            }),
        }
    }
}
