//! The input of passes.

use crate::layout::Layout;
use xca_core::engine::StepContext;
use xca_core::{Model, Precision};

/// Processes that run together over all rows in a step.
#[derive(Clone, Copy)]
pub(crate) struct StageOfStep<'a> {
    pub(crate) processes: &'a [usize],
    pub(crate) context: StepContext<'a>,
}

/// The common input of passes.
#[derive(Clone, Copy)]
pub(crate) struct Ground<'a> {
    pub(crate) model: &'a Model,
    pub(crate) layout: &'a Layout,
    pub(crate) precision: Precision,
}
