//! The items of a population, as engines and simulations pass them on.

/// All items of a population, by cell and label.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Population {
    /// The number of items in each cell.
    pub counts: Vec<u32>,
    /// The labels.
    pub labels: Vec<u32>,
    /// The stored bytes of each field.
    pub fields: Vec<Vec<u8>>,
}
