//! The files that a run has written up to its checkpoint.

use crate::Exact;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use xca_io::table_csv::Written;

/// The records of a run, as a checkpoint keeps them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Recorded {
    /// The steps after which a state was recorded.
    pub steps: Vec<u64>,
    /// The length of the time series.
    pub series: Written,
    /// The observables before the first step.
    pub first: Vec<Quantity>,
    /// The observables after the last of these steps.
    pub last: Vec<Quantity>,
    /// The data that each format needs to resume.
    pub formats: Map<String, Value>,
}

impl Recorded {
    /// Whether this can be the record of a run at `step`: the steps ascend, each is there once, and none is
    /// later.
    pub(crate) fn can_be_after(&self, step: u64) -> bool {
        self.steps.is_sorted_by(|one, next| one < next) && self.steps.last().is_none_or(|last| *last <= step)
    }
}

/// An observable, exact to the last bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// Its name.
    pub name: String,
    /// Its unit. Empty for a number without a unit.
    pub unit: String,
    /// Its value.
    pub value: Exact,
    /// Whether the model conserves it.
    pub is_conserved: bool,
}
