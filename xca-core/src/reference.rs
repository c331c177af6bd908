//! The reference engine: serial, plain, dense slots.
//!
//! Tests compare all other engines with it, and speed-ups are relative to it. Each process is one pass over
//! all cells. For each cell the boundary rules find the neighbours, one by one. Every cell holds all its
//! slots, as in De Rango et al., section III. The other engines share only the processes with it.

mod execution;
mod migration;
mod pass;

use crate::engine::{Engine, Execution, StartError};
use crate::model::{GroupKind, Model};
use crate::storage::Buffer;
use xca_process::{Face, Faces, Geometry, Reached};
use xca_values::{Precision, StoredType};

/// The serial reference engine: one core, the definition of the result that all other engines match.
///
/// ```
/// # use xca_core::prelude::*;
/// # #[derive(Substates, Clone, Copy)]
/// # struct Heat { temperature: Real }
/// # let model = Model::builder("heat").extents([8, 8, 1]).substates::<Heat>().build()?;
/// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// simulation.run(10)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct Reference;

impl Engine for Reference {
    fn name(&self) -> &str {
        "reference"
    }

    fn threads(&self) -> usize {
        1
    }

    fn least_memory(&self, model: &Model, precision: Precision) -> u128 {
        let cells = model.geometry().cells() as u128;
        let of_group = |group: &crate::model::Group| {
            let size: usize = group.stored(precision).iter().map(|stored| stored.size()).sum();
            let labels_and_counts = size_of::<u32>() as u128;
            match group.kind() {
                GroupKind::Cells { .. } => cells * size as u128,
                GroupKind::Population { slots, .. } => {
                    cells * (*slots as u128 * (size as u128 + labels_and_counts) + labels_and_counts)
                }
            }
        };
        model.groups().iter().map(of_group).sum()
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let cells = model.geometry().cells();
        let groups = model
            .groups()
            .iter()
            .map(|group| group_state(group, cells, precision))
            .collect::<Result<_, _>>()?;
        Ok(Box::new(ReferenceExecution { model: model.clone(), precision, groups }))
    }
}

fn group_state(
    group: &crate::model::Group,
    cells: usize,
    precision: Precision,
) -> Result<GroupState, StartError> {
    let types = group.stored(precision);
    let (slots, outside) = match group.kind() {
        GroupKind::Cells { .. } => {
            (1, (0..types.len()).filter_map(|field| group.outside(field, precision)).collect())
        }
        GroupKind::Population { slots, .. } => (*slots, Vec::new()),
    };
    let size: usize = types.iter().map(|stored| stored.size()).sum();
    let too_large = |what: &str, wanted: u128, limit: u128| StartError::TooLarge {
        engine: "reference".to_owned(),
        what: what.to_owned(),
        wanted,
        limit,
    };
    let places = cells as u128 * slots as u128;
    if places > u128::from(u32::MAX) {
        return Err(too_large("the number of slots of all cells", places, u128::from(u32::MAX)));
    }
    // A quarter of the address space is more than any machine has; below that the system says what it has.
    let bytes = places * size as u128;
    if bytes > 1 << 45 {
        return Err(too_large("the bytes of the state", bytes, 1 << 45));
    }
    let places = cells * slots;
    Ok(GroupState {
        slots,
        planes: types.iter().map(|stored| Buffer::zeroed(stored.size() * places)).collect(),
        counts: if matches!(group.kind(), GroupKind::Population { .. }) {
            vec![0; cells]
        } else {
            Vec::new()
        },
        labels: if matches!(group.kind(), GroupKind::Population { .. }) {
            vec![0; places]
        } else {
            Vec::new()
        },
        types,
        outside,
        left: 0,
    })
}

/// The state of a model on the reference engine.
struct ReferenceExecution {
    model: Model,
    precision: Precision,
    groups: Vec<GroupState>,
}

/// The substates of one struct: of cells with one place each, or of items with as many places a cell as it
/// has slots.
struct GroupState {
    types: Vec<StoredType>,
    /// The places of a cell: 1 for cells.
    slots: usize,
    /// For each field all places, cell after cell.
    planes: Vec<Buffer>,
    /// For cells, the values of each field beyond flat faces.
    outside: Vec<Faces<Vec<u8>>>,
    /// For populations, the occupied slots of each cell: the first ones, by label.
    counts: Vec<u32>,
    /// For populations, the label in each slot.
    labels: Vec<u32>,
    /// How many items have left.
    left: u64,
}

impl GroupState {
    fn value(&self, field: usize, place: usize) -> &[u8] {
        let size = self.types[field].size();
        &self.planes[field].bytes()[place * size..(place + 1) * size]
    }

    fn value_mut(&mut self, field: usize, place: usize) -> &mut [u8] {
        let size = self.types[field].size();
        &mut self.planes[field].bytes_mut()[place * size..(place + 1) * size]
    }

    /// The occupied places, cell after cell.
    fn occupied(&self) -> impl Iterator<Item = usize> + '_ {
        let slots = self.slots;
        self.counts
            .iter()
            .enumerate()
            .flat_map(move |(cell, count)| cell * slots..cell * slots + *count as usize)
    }
}

/// What a cell sees in the place of a neighbour.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Neighbour {
    /// The cell with this linear index.
    Cell(usize),
    /// What lies beyond a flat face.
    Outside(Face),
}

/// The neighbourhood of a cell, by the boundary rules.
fn neighbourhood(geometry: &Geometry, cell: [usize; 3]) -> impl Iterator<Item = Neighbour> + '_ {
    let displacements = geometry.neighbourhood().displacements(cell);
    displacements.iter().map(move |displacement| match geometry.reach(cell, *displacement) {
        Reached::Cell(at) => Neighbour::Cell(geometry.linear(at)),
        Reached::Outside(face) => Neighbour::Outside(face),
    })
}
