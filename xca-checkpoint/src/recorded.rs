//! What a run has written until its checkpoint.

use crate::Exact;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use xca_io::table_csv::Written;

/// What a recorder has written, as a checkpoint keeps it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Recorded {
    /// The steps after which the state was recorded.
    pub steps: Vec<u64>,
    /// How long the time series was.
    pub series: Written,
    /// The observables before the first step.
    pub first: Vec<Quantity>,
    /// Those of the last of the steps.
    pub last: Vec<Quantity>,
    /// What each format has to know.
    pub formats: Map<String, Value>,
}

impl Recorded {
    /// Whether this can have been recorded until that step: in order, and each step once.
    pub(crate) fn can_be_after(&self, step: u64) -> bool {
        self.steps.is_sorted_by(|one, next| one < next) && self.steps.last().is_none_or(|last| *last <= step)
    }
}

/// An observable that is kept to the last bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// What it is called.
    pub name: String,
    /// Its unit; empty of a number without one.
    pub unit: String,
    /// Its value.
    pub value: Exact,
    /// Whether the model keeps it.
    pub is_conserved: bool,
}
