//! The number of a substate in a model.

/// A substate of a model: the number of its group, and of the field in the group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct SubstateId {
    /// The number of the group, in the order of the model.
    pub group: usize,
    /// The number of the field.
    pub field: usize,
}
