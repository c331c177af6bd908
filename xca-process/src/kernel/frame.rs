//! The data that all rows of a step share.

use super::CellFilter;
use std::any::Any;
use std::sync::Arc;
use xca_space::Geometry;
use xca_values::Stream;

/// The data that all rows of a step share.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// The shape of the space.
    pub geometry: &'a Geometry,
    /// The number of cells along x, y, z.
    pub extents: [u32; 3],
    /// The side of a cell in metres.
    pub side: f64,
    /// Which axes are toroidal.
    pub toroidal: [bool; 3],
    /// The number of the step, from 0.
    pub step: u64,
    /// The seed of the run's random numbers.
    pub seed: u64,
    /// The stream of the process's random numbers.
    pub stream: Stream,
    /// `P::Native<R>` of each struct of the model's parameters.
    pub parameters: &'a [Arc<dyn Any + Send + Sync>],
    /// The distance in elements from a cell to each cell of its neighbourhood. Index 0 is the cell itself.
    pub offsets: &'a [isize],
    /// The cells that a search can skip. `None`: search all cells.
    pub filter: Option<&'a CellFilter>,
}
