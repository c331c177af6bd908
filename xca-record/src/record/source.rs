//! A state whose values are read when they are needed.

use xca_core::engine::{LabelledItems, SubstateId};
use xca_core::{EngineFailure, GroupSnapshot, Simulation, Snapshot};

/// The number of bytes that are read at a time.
pub(super) const BLOCK: usize = 4 << 20;

/// Where the values of a state come from.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Source<'a> {
    Simulation(&'a Simulation),
    Snapshot(&'a Snapshot),
}

impl<'a> Source<'a> {
    /// The number of steps done.
    pub(crate) fn step(self) -> u64 {
        match self {
            Self::Simulation(simulation) => simulation.step_number(),
            Self::Snapshot(snapshot) => snapshot.step,
        }
    }

    /// Passes on all values of a substate in blocks of whole values.
    pub(crate) fn blocks<E: From<EngineFailure>>(
        self,
        substate: SubstateId,
        mut take: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        match self {
            Self::Simulation(simulation) => simulation.read_substate(substate, BLOCK, take),
            Self::Snapshot(snapshot) => take(of_snapshot(snapshot, substate)),
        }
    }

    /// All values of a substate.
    pub(crate) fn values(self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        let mut values = Vec::new();
        self.blocks(substate, |block| {
            values.extend_from_slice(block);
            Ok::<(), EngineFailure>(())
        })?;
        Ok(values)
    }

    /// The values of a substate, of this size in bytes, in the cells with these linear indices.
    pub(crate) fn values_in(
        self,
        substate: SubstateId,
        size: usize,
        cells: &[usize],
    ) -> Result<Vec<u8>, EngineFailure> {
        match self {
            Self::Simulation(simulation) => simulation.read_cells(substate, cells),
            Self::Snapshot(snapshot) => {
                let values = of_snapshot(snapshot, substate);
                Ok(cells.iter().flat_map(|cell| &values[cell * size..(cell + 1) * size]).copied().collect())
            }
        }
    }

    /// Passes on the items of a population, by label, in blocks. `sizes` are those of their substates in
    /// bytes.
    pub(crate) fn items<E: From<EngineFailure>>(
        self,
        group: usize,
        sizes: &[usize],
        mut take: impl FnMut(LabelledItems) -> Result<(), E>,
    ) -> Result<(), E> {
        match self {
            Self::Simulation(simulation) => simulation.read_items(group, take),
            Self::Snapshot(snapshot) => match &snapshot.groups[group] {
                GroupSnapshot::Population(population, _) => {
                    take(LabelledItems::of(population.clone(), sizes, |cell| cell as u32))
                }
                GroupSnapshot::Cells(_) => Ok(()),
            },
        }
    }
}

fn of_snapshot(snapshot: &Snapshot, substate: SubstateId) -> &[u8] {
    match &snapshot.groups[substate.group] {
        GroupSnapshot::Cells(fields) => &fields[substate.field],
        GroupSnapshot::Population(population, _) => &population.fields[substate.field],
    }
}
