//! What all parts know.

use crate::cut::Cut;
use xca_core::{Model, Precision};

/// A model with its cut, as all parts know it.
#[derive(Clone)]
pub(crate) struct Shared {
    pub(crate) model: Model,
    pub(crate) precision: Precision,
    pub(crate) cut: Cut,
}
