//! Commands of the host, and replies of the parts.

use crate::cut::Cut;
use crate::fault::FaultMessage;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use xca_core::engine::{LabelledItems, Plane, Population, RowWork, StepContext, SubstateId};
use xca_core::reduction::{ReducedRows, Reduction};

/// A command. All parts get the same commands, with the data of their own cells.
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
    /// Replaces the values of cells in the own ones of these rows of the whole space.
    WriteRows {
        substate: SubstateId,
        rows: Range<usize>,
        #[serde(with = "serde_bytes")]
        values: Vec<u8>,
    },
    /// Requests the bytes of a plane in the own ones of these rows of the whole space.
    ReadRows {
        plane: Plane,
        rows: Range<usize>,
    },
    Population {
        group: usize,
    },
    SetPopulation {
        group: usize,
        population: Population,
    },
    /// Takes the bytes of a plane of a population in the next own rows, to replace its items by. `begins`
    /// for the first rows.
    CollectItems {
        plane: Plane,
        begins: bool,
        #[serde(with = "serde_bytes")]
        bytes: Vec<u8>,
    },
    /// Replaces the items of a population by those that were collected.
    SetCollectedItems {
        group: usize,
    },
    /// Requests the number of items in each block of labels.
    LabelCounts {
        group: usize,
    },
    /// Requests the items with labels in this range.
    LabelledItems {
        group: usize,
        labels: Range<u64>,
    },
    /// Requests the number of items in each row.
    ItemsOfRows {
        group: usize,
    },
    Census {
        group: usize,
    },
    /// Requests the work of each row since the start.
    Work,
    /// Moves the bounds of parts, and the state with them.
    Move {
        cut: Cut,
    },
    Memory,
    Figures,
}

impl Command {
    /// Whether it only asks for something.
    pub(crate) fn is_question(&self) -> bool {
        match self {
            Self::Read { .. }
            | Self::ReadCells { .. }
            | Self::ReduceRows { .. }
            | Self::ReadRows { .. }
            | Self::Population { .. }
            | Self::LabelCounts { .. }
            | Self::LabelledItems { .. }
            | Self::ItemsOfRows { .. }
            | Self::Census { .. }
            | Self::Work
            | Self::Memory
            | Self::Figures => true,
            Self::Run { .. }
            | Self::RunSteps { .. }
            | Self::Write { .. }
            | Self::WriteCells { .. }
            | Self::WriteRows { .. }
            | Self::SetPopulation { .. }
            | Self::CollectItems { .. }
            | Self::SetCollectedItems { .. }
            | Self::Move { .. } => false,
        }
    }
}

/// The content of a [`StepContext`], as numbers.
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

/// A reply of a part.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Reply {
    Done,
    /// The part has the first fault, after `done` whole steps.
    Fault {
        done: u64,
        fault: FaultMessage,
    },
    /// The items that were collected are none of the model's.
    Refused {
        reason: String,
    },
    /// Another part has the first fault, or has failed.
    Elsewhere {
        done: u64,
    },
    /// The part has failed.
    Failed {
        reason: String,
    },
    Values {
        #[serde(with = "serde_bytes")]
        values: Vec<u8>,
    },
    /// Whether the engine of the part can write rows.
    Written {
        is_possible: bool,
    },
    /// The bytes of rows, and for items the number in each row. No bytes if the engine of the part reads
    /// whole planes only.
    BytesOfRows {
        bytes: Option<serde_bytes::ByteBuf>,
        items: Vec<usize>,
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
    LabelCounts {
        counts: Vec<u32>,
    },
    LabelledItems {
        items: LabelledItems,
    },
    Census {
        census: Census,
    },
    Work {
        work: RowWork,
    },
    Memory {
        bytes: usize,
    },
    Figures {
        figures: Vec<(String, f64)>,
    },
}

/// The counts of a population.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(crate) struct Census {
    pub(crate) items: usize,
    pub(crate) left: u64,
    pub(crate) largest_occupancy: u32,
}

/// Encodes a message as bytes.
pub(crate) fn encode<M: Serialize>(message: &M) -> Result<Vec<u8>, String> {
    postcard::to_stdvec(message).map_err(|error| format!("a message cannot be written: {error}"))
}

/// Decodes a message from bytes.
pub(crate) fn decode<M: DeserializeOwned>(bytes: &[u8]) -> Result<M, String> {
    postcard::from_bytes(bytes)
        .map_err(|error| format!("a message cannot be read ({error}); all parts must be of the same build"))
}
