//! What a test or a benchmark chooses in place of the engine.

/// What is chosen instead of what the engine finds best.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Choices {
    /// The skin of lists of what is near, in radii of a search.
    pub(crate) skin: Option<f64>,
    pub(crate) leave_out: LeaveOut,
    /// How many steps are done together.
    pub(crate) stride: Option<u64>,
    /// The rows of the columns in which they are done.
    pub(crate) column: Option<usize>,
}

/// When cells are left out in which nothing can change.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) enum LeaveOut {
    #[default]
    WhereItPays,
    /// In tiles of so many cells.
    Always(usize),
    Never,
}
