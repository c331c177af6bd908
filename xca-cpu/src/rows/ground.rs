//! The input of passes.

use crate::layout::Layout;
use crate::stages::Stage;
use xca_core::engine::StepContext;
use xca_core::{Model, Precision};

/// Processes that run together over all rows in a step.
#[derive(Clone, Copy)]
pub(crate) struct StageOfStep<'a> {
    pub(crate) processes: &'a [usize],
    pub(crate) context: StepContext<'a>,
}

impl<'a> StageOfStep<'a> {
    pub(crate) fn new((context, processes): &'a (StepContext<'a>, Stage)) -> Self {
        Self { processes, context: *context }
    }
}

/// The common input of passes.
#[derive(Clone, Copy)]
pub(crate) struct Ground<'a> {
    pub(crate) model: &'a Model,
    pub(crate) layout: &'a Layout,
    pub(crate) precision: Precision,
}
