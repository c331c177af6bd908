//! What is read back of a saved state.

use xca_io::vtk::ReadArray;

/// What a file of one state holds: of cells or of items.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SavedState {
    /// The simulated time.
    pub time: f64,
    /// Of cells, how many there are along each axis.
    pub cells: Option<[usize; 3]>,
    /// The cells without ground, where the file tells them.
    pub hidden: Option<Vec<bool>>,
    /// Of items, where they are on the map.
    pub positions: Option<ReadArray>,
    /// The substates.
    pub arrays: Vec<ReadArray>,
}

impl SavedState {
    /// The values of cells.
    pub fn of_cells(time: f64, cells: [usize; 3], arrays: Vec<ReadArray>) -> Self {
        Self { time, cells: Some(cells), hidden: None, positions: None, arrays }
    }

    /// The values of items, their labels among them.
    pub fn of_items(time: f64, positions: ReadArray, arrays: Vec<ReadArray>) -> Self {
        Self { time, cells: None, hidden: None, positions: Some(positions), arrays }
    }
}
