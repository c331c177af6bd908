//! Data that all parts have.

use crate::cut::Cut;
use xca_core::{Model, Precision};

/// A model with its precision and cut.
#[derive(Clone)]
pub(crate) struct Shared {
    pub(crate) model: Model,
    pub(crate) precision: Precision,
    pub(crate) cut: Cut,
}
