//! The planes of a state: its lists of numbers.

use super::SubstateId;
use crate::model::{Group, GroupKind};

/// A list of numbers in a state. Those of cells come by linear index, those of items by cell and label.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Plane {
    /// The stored bytes of a substate.
    Values(SubstateId),
    /// The number of items in each cell, of the population with this number: `u32`.
    Counts(usize),
    /// The labels of the items of the population with this number: `u32`.
    Labels(usize),
}

impl Plane {
    /// All planes of a group with this number, in the order of checkpoints.
    pub fn of_group(number: usize, group: &Group) -> Vec<Self> {
        let values = (0..group.schema().fields.len()).map(|field| SubstateId { group: number, field });
        let of_items = match group.kind() {
            GroupKind::Cells { .. } => Vec::new(),
            GroupKind::Population { .. } => vec![Self::Counts(number), Self::Labels(number)],
        };
        of_items.into_iter().chain(values.map(Self::Values)).collect()
    }

    /// The number of its group.
    pub fn group(self) -> usize {
        match self {
            Self::Values(substate) => substate.group,
            Self::Counts(group) | Self::Labels(group) => group,
        }
    }
}
