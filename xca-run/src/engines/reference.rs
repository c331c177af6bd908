//! The reference engine.

use super::kind::EngineKind;
use super::options::EngineOptions;
use xca_core::{Engine, Reference};
use xca_record::Failure;

/// Has nothing to choose.
#[derive(Debug)]
pub(super) struct ReferenceKind;

impl EngineKind for ReferenceKind {
    fn name(&self) -> &'static str {
        "reference"
    }

    fn about(&self) -> &'static str {
        "Serial and plain: the oracle of the others"
    }

    fn make(&self, _options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        Ok(Box::new(Reference))
    }
}
