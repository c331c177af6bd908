//! What the host says to the parts, and what they answer.

use crate::fault::FaultMessage;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use xca_core::engine::{Population, StepContext, SubstateId};
use xca_core::reduction::{ReducedRows, Reduction};

/// What a part is to do. All parts get the same commands, with what concerns their own cells.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) enum Command {
    Run {
        processes: Range<usize>,
        moment: Moment,
    },
    RunSteps {
        steps: u64,
        moment: Moment,
    },
    Read {
        substate: SubstateId,
    },
    Write {
        substate: SubstateId,
        #[serde(with = "serde_bytes")]
        values: Vec<u8>,
    },
    ReadCells {
        substate: SubstateId,
        cells: Vec<usize>,
    },
    WriteCells {
        substate: SubstateId,
        cells: Vec<usize>,
        #[serde(with = "serde_bytes")]
        values: Vec<u8>,
    },
    ReduceRows {
        substate: SubstateId,
        reduction: Reduction,
    },
    Population {
        group: usize,
    },
    SetPopulation {
        group: usize,
        population: Population,
    },
    /// How many items each row has.
    ItemsOfRows {
        group: usize,
    },
    Census {
        group: usize,
    },
    Memory,
    Figures,
}

/// What a [`StepContext`] says, as numbers.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Moment {
    pub(crate) step: u64,
    pub(crate) seed: u64,
    /// The bits of all parameters.
    pub(crate) parameters: Vec<Vec<u64>>,
}

impl Moment {
    pub(crate) fn new(context: &StepContext<'_>) -> Self {
        Self { step: context.step, seed: context.seed, parameters: context.values.bits() }
    }
}

/// What a part answers.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Reply {
    Done,
    /// The part has the first fault, after so many whole steps.
    Fault {
        done: u64,
        fault: FaultMessage,
    },
    /// Another part has, or cannot go on.
    Elsewhere {
        done: u64,
    },
    /// The part cannot go on.
    Failed {
        reason: String,
    },
    Values {
        #[serde(with = "serde_bytes")]
        values: Vec<u8>,
    },
    Rows {
        rows: ReducedRows,
    },
    Population {
        population: Population,
    },
    ItemsOfRows {
        items: Vec<usize>,
    },
    Census {
        census: Census,
    },
    Memory {
        bytes: usize,
    },
    Figures {
        figures: Vec<(String, f64)>,
    },
}

/// What there is to count of a population.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(crate) struct Census {
    pub(crate) items: usize,
    pub(crate) left: u64,
    pub(crate) largest_occupancy: u32,
}

/// A message as bytes.
pub(crate) fn encode<M: Serialize>(message: &M) -> Result<Vec<u8>, String> {
    postcard::to_stdvec(message).map_err(|error| format!("a message cannot be written: {error}"))
}

/// A message out of its bytes.
pub(crate) fn decode<M: DeserializeOwned>(bytes: &[u8]) -> Result<M, String> {
    postcard::from_bytes(bytes)
        .map_err(|error| format!("a message cannot be read ({error}); all parts must be of the same build"))
}
