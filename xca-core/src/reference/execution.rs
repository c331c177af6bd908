//! The state as simulations ask for it.

use super::{GroupState, ReferenceExecution};
use crate::engine::{Execution, Fault, Population, StepContext, SubstateId};
use crate::process::ProcessKind;
use crate::reduction::{ITEMS_IN_BLOCK, Reduced, Reduction, reduce_values};
use std::ops::Range;

impl Execution for ReferenceExecution {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        for index in processes {
            let process = self.model.processes()[index];
            let answers = self.pass(&process, context)?;
            if process.kind == ProcessKind::Migration {
                self.migrate(&process, &answers)?;
            }
        }
        Ok(())
    }

    fn read(&self, substate: SubstateId) -> Vec<u8> {
        let group = &self.groups[substate.group];
        if !group.is_population() {
            return group.planes[substate.field].bytes().to_vec();
        }
        group.occupied().flat_map(|place| group.value(substate.field, place)).copied().collect()
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) {
        let group = &mut self.groups[substate.group];
        if !group.is_population() {
            group.planes[substate.field].bytes_mut().copy_from_slice(values);
            return;
        }
        let places: Vec<usize> = group.occupied().collect();
        let size = group.types[substate.field].size();
        for (place, value) in places.into_iter().zip(values.chunks_exact(size)) {
            group.value_mut(substate.field, place).copy_from_slice(value);
        }
    }

    fn read_cell(&self, substate: SubstateId, cell: usize) -> Vec<u8> {
        self.groups[substate.group].value(substate.field, cell).to_vec()
    }

    fn write_cell(&mut self, substate: SubstateId, cell: usize, value: &[u8]) {
        self.groups[substate.group].value_mut(substate.field, cell).copy_from_slice(value);
    }

    fn population(&self, group: usize) -> Population {
        let fields =
            (0..self.groups[group].types.len()).map(|field| self.read(SubstateId { group, field })).collect();
        let group = &self.groups[group];
        let labels = group.occupied().map(|place| group.labels[place]).collect();
        Population { counts: group.counts.clone(), labels, fields }
    }

    fn set_population(&mut self, number: usize, population: &Population) -> Result<(), Fault> {
        let geometry = self.model.geometry();
        let group = &mut self.groups[number];
        let slots = group.slots;
        if let Some(cell) = population.counts.iter().position(|count| *count as usize > slots) {
            let items = population.counts[cell] as usize;
            return Err(Fault::CellFull { process: None, cell: geometry.indices(cell), items, slots });
        }
        group.counts.clone_from(&population.counts);
        let places: Vec<usize> = group.occupied().collect();
        for (index, &place) in places.iter().enumerate() {
            group.labels[place] = population.labels[index];
            for field in 0..group.types.len() {
                let size = group.types[field].size();
                let value = &population.fields[field][index * size..(index + 1) * size];
                group.value_mut(field, place).copy_from_slice(value);
            }
        }
        Ok(())
    }

    fn items(&self, group: usize) -> usize {
        self.groups[group].counts.iter().map(|count| *count as usize).sum()
    }

    fn left(&self, group: usize) -> u64 {
        self.groups[group].left
    }

    fn largest_occupancy(&self, group: usize) -> u32 {
        self.groups[group].counts.iter().copied().max().unwrap_or(0)
    }

    fn reduce(&self, substate: SubstateId, reduction: &Reduction) -> Vec<Reduced> {
        let group = &self.groups[substate.group];
        let stored = group.types[substate.field];
        let block = if group.is_population() { ITEMS_IN_BLOCK } else { self.model.geometry().extents()[0] };
        let mut results = vec![Reduced::Nothing; usize::from(stored.lanes)];
        for values in self.read(substate).chunks(block * stored.size()) {
            for (result, part) in results.iter_mut().zip(reduce_values(reduction, stored, values)) {
                *result = result.combine(part, reduction);
            }
        }
        results
    }

    fn memory(&self) -> usize {
        self.groups.iter().map(GroupState::memory).sum()
    }
}

impl GroupState {
    fn memory(&self) -> usize {
        let planes: usize = self.planes.iter().map(crate::storage::Buffer::capacity).sum();
        planes + (self.counts.capacity() + self.labels.capacity()) * size_of::<u32>()
    }
}
