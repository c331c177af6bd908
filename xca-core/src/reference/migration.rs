//! Migration: every item to the cell that the model names, in the order of labels.

use super::{GroupState, Neighbour, ReferenceExecution, neighbourhood};
use crate::engine::Fault;
use crate::model::GroupKind;
use crate::storage::Buffer;
use xca_process::Process;
use xca_process::kernel::{NOWHERE, OUTSIDE, STAY};

impl ReferenceExecution {
    /// Moves the items of a population as the answers, one for each place, say.
    pub(super) fn migrate(&mut self, process: &Process, answers: &[u32]) -> Result<(), Fault> {
        let Some(number) = self.population_of(process) else { return Ok(()) };
        let geometry = self.model.geometry().clone();
        let GroupKind::Population { slots, may_leave } = *self.model.groups()[number].kind() else {
            return Ok(());
        };
        let group = &self.groups[number];
        let mut arrivals: Vec<Vec<usize>> = vec![Vec::new(); geometry.cells()];
        let mut left = 0;
        for cell in 0..geometry.cells() {
            let (first, end) = group.range(cell);
            for (place, &answer) in (first..end).zip(&answers[first..end]) {
                let (name, label, from) = (process.name, group.labels[place], geometry.indices(cell));
                let target = match answer {
                    STAY => cell,
                    NOWHERE => return Err(Fault::Nowhere { process: name, label, cell: from }),
                    OUTSIDE if may_leave => {
                        left += 1;
                        continue;
                    }
                    OUTSIDE => return Err(Fault::Left { process: name, label, cell: from }),
                    other => other as usize,
                };
                if target != cell
                    && !neighbourhood(&geometry, from).any(|near| near == Neighbour::Cell(target))
                {
                    return Err(Fault::TooFar { process: name, label, from, to: geometry.indices(target) });
                }
                arrivals[target].push(place);
            }
        }
        for (cell, places) in arrivals.iter_mut().enumerate() {
            if places.len() > slots {
                let (process, items) = (Some(process.name), places.len());
                return Err(Fault::CellFull { process, cell: geometry.indices(cell), items, slots });
            }
            places.sort_unstable_by_key(|place| group.labels[*place]);
        }
        let moved = rearranged(group, &arrivals);
        self.groups[number] = GroupState { left: group.left + left, ..moved };
        Ok(())
    }
}

fn rearranged(group: &GroupState, arrivals: &[Vec<usize>]) -> GroupState {
    let mut moved = GroupState {
        types: group.types.clone(),
        slots: group.slots,
        planes: group.planes.iter().map(|plane| Buffer::zeroed(plane.len())).collect(),
        outside: Vec::new(),
        counts: arrivals.iter().map(|places| places.len() as u32).collect(),
        labels: vec![0; group.labels.len()],
        left: group.left,
    };
    for (cell, places) in arrivals.iter().enumerate() {
        for (slot, &place) in places.iter().enumerate() {
            let target = cell * group.slots + slot;
            moved.labels[target] = group.labels[place];
            for field in 0..group.types.len() {
                moved.value_mut(field, target).copy_from_slice(group.value(field, place));
            }
        }
    }
    moved
}
