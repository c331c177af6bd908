//! What can be wrong with a CADEM system.

use crate::face::Face;
use crate::initial::PlacementError;
use crate::particles::ParticleError;
use xca_core::{ModelError, ParameterError};

/// A system that makes no sense; the message says what to change.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum CademError {
    #[error("unknown case `{name}`; use illustration, table1 or published")]
    UnknownCase { name: String },
    #[error(
        "the cell side is {cell_side} m; it must be finite, and at least two radii of {radius} m, so that no contact \
         reaches beyond the neighbours"
    )]
    CellSide { cell_side: f64, radius: f64 },
    #[error("the space has {cells:?} cells; each of the three numbers must be at least 1")]
    NoCells { cells: [usize; 3] },
    #[error(
        "the opening of the face {face} from cell {first:?} to {last:?} is invalid: that face has \
         {extents:?} cells, numbered from 0, and the first \
         cell comes before the last"
    )]
    Opening { face: Face, first: [usize; 2], last: [usize; 2], extents: [usize; 2] },
    #[error(
        "{slots} slots do not hold the {faces} BOUNDARY slots of cell {cell:?}; give the cells more slots"
    )]
    FewSlots { slots: usize, cell: [usize; 3], faces: usize },
    #[error(
        "the walls of {cells:?} cells need {wanted} BOUNDARY slots; labels for {limit} are there; use fewer cells"
    )]
    ManyBoundarySlots { cells: [usize; 3], wanted: u64, limit: u64 },
    #[error(transparent)]
    Particle(#[from] ParticleError),
    #[error(transparent)]
    Placement(#[from] PlacementError),
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    #[error(transparent)]
    Model(#[from] ModelError),
}
