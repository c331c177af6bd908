//! The work in each row, as engines count it.

/// How much an execution has worked in each row since its start.
///
/// A cell or an item counts once for each process that has run on it. A cell that was skipped does not count.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct RowWork {
    /// The cells that processes have run on, of each row.
    pub cells: Vec<u64>,
    /// The items that processes have run on, of each row.
    pub items: Vec<u64>,
}
