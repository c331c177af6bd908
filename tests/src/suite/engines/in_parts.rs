//! Models of cells in parts of their space; those of populations, which cannot be cut yet, whole.

use std::error::Error;
use std::num::NonZeroUsize;
use xca_core::engine::{Execution, StartError};
use xca_core::model::GroupKind;
use xca_core::{Engine, Model, Precision};
use xca_cpu::Cpu;
use xca_parts::Parts;

/// The CPU engine on parts of a space that share its threads.
#[derive(Debug)]
pub(super) struct InParts {
    whole: Cpu,
    parts: Parts,
}

impl InParts {
    /// So many parts at most, with so many threads and, if they are chosen, with tiles of so many cells.
    pub(super) fn new(
        parts: usize,
        threads: usize,
        tile: Option<NonZeroUsize>,
    ) -> Result<Self, Box<dyn Error>> {
        let mut whole = Cpu::with_threads(threads)?;
        if let Some(cells) = tile {
            whole = whole.with_tiles(cells);
        }
        let parts = Parts::at_most(whole.clone(), NonZeroUsize::new(parts).ok_or("no parts")?);
        Ok(Self { whole, parts })
    }
}

impl Engine for InParts {
    fn name(&self) -> &str {
        self.whole.name()
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        self.parts.facts()
    }

    fn threads(&self) -> usize {
        self.whole.threads()
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let is_population =
            |group: &xca_core::model::Group| matches!(group.kind(), GroupKind::Population { .. });
        if model.groups().iter().any(is_population) {
            self.whole.start(model, precision)
        } else {
            self.parts.start(model, precision)
        }
    }
}
