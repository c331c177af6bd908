//! Settings of tests and benchmarks that replace the choices of the engine.

/// The settings that replace choices of the engine.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Choices {
    /// The skin of neighbour lists, in search radii.
    pub(crate) skin: Option<f64>,
    pub(crate) leave_out: LeaveOut,
    /// The number of steps done together.
    pub(crate) stride: Option<u64>,
    /// The number of rows of the columns in which they are done.
    pub(crate) column: Option<usize>,
}

/// When the engine skips cells in which nothing can change.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) enum LeaveOut {
    #[default]
    WhereItPays,
    /// Always, in tiles of this many cells.
    Always(usize),
    Never,
}
