//! Data that all parts have.

use crate::cut::Cut;
use crate::grid::Grid;
use xca_core::{Model, Precision};

/// A model with its precision and cut.
#[derive(Clone)]
pub(crate) struct Shared {
    pub(crate) model: Model,
    pub(crate) precision: Precision,
    pub(crate) cut: Cut,
}

impl Shared {
    /// At the start: with rows that are distributed evenly.
    pub(crate) fn even(model: &Model, precision: Precision, grid: Grid) -> Self {
        Self { model: model.clone(), precision, cut: Cut::even(model.geometry(), grid) }
    }
}
