//! The state as simulations ask for it.

use super::{GroupState, ReferenceExecution};
use crate::engine::{
    EngineFailure, Execution, Fault, Interruption, Population, StepContext, SubstateId, check_cells,
    check_population, check_substate, check_values, check_values_of_cells, step_by_step,
};
use crate::reduction::{ReducedRows, Reduction, append_row};
use std::ops::Range;
use xca_process::ProcessKind;
use xca_process::Stream;

impl Execution for ReferenceExecution {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        for index in processes {
            let process = self.model.processes()[index];
            if !process.is_due(context.step) {
                continue;
            }
            let answers = self.pass(&process, Stream::process(index), context)?;
            if process.kind == ProcessKind::Migration {
                self.migrate(&process, &answers)?;
            }
        }
        Ok(())
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        let processes = self.model.processes().len();
        step_by_step(steps, context, |context| self.run(0..processes, context))
    }

    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        check_substate(&self.model, substate)?;
        Ok(self.groups[substate.group].values(substate.field, self.cells()))
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        check_values(&self.model, self.precision, substate, self.items(substate.group), values)?;
        let group = &mut self.groups[substate.group];
        if !group.is_population() {
            group.planes[substate.field].bytes_mut().copy_from_slice(values);
            return Ok(());
        }
        let places: Vec<usize> = group.occupied().collect();
        let size = group.types[substate.field].size();
        for (place, value) in places.into_iter().zip(values.chunks_exact(size)) {
            group.value_mut(substate.field, place).copy_from_slice(value);
        }
        Ok(())
    }

    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure> {
        check_cells(&self.model, substate, cells)?;
        let group = &self.groups[substate.group];
        Ok(cells.iter().flat_map(|cell| group.value(substate.field, *cell)).copied().collect())
    }

    fn write_cells(
        &mut self,
        substate: SubstateId,
        cells: &[usize],
        values: &[u8],
    ) -> Result<(), EngineFailure> {
        check_values_of_cells(&self.model, self.precision, substate, cells, values)?;
        let group = &mut self.groups[substate.group];
        let size = group.types[substate.field].size();
        for (cell, value) in cells.iter().zip(values.chunks_exact(size)) {
            group.value_mut(substate.field, *cell).copy_from_slice(value);
        }
        Ok(())
    }

    fn population(&self, group: usize) -> Result<Population, EngineFailure> {
        let group = &self.groups[group];
        let fields = (0..group.types.len()).map(|field| group.values(field, self.cells())).collect();
        let labels = group.occupied().map(|place| group.labels[place]).collect();
        Ok(Population { counts: group.counts.clone(), labels, fields })
    }

    fn set_population(&mut self, number: usize, population: &Population) -> Result<(), Fault> {
        check_population(&self.model, self.precision, number, population)?;
        let group = &mut self.groups[number];
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
        self.groups.get(group).map_or(0, |group| group.counts.iter().map(|count| *count as usize).sum())
    }

    fn left(&self, group: usize) -> u64 {
        self.groups[group].left
    }

    fn largest_occupancy(&self, group: usize) -> Result<u32, EngineFailure> {
        Ok(self.groups[group].counts.iter().copied().max().unwrap_or(0))
    }

    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure> {
        check_substate(&self.model, substate)?;
        let group = &self.groups[substate.group];
        let stored = group.types[substate.field];
        let geometry = self.model.geometry();
        let width = geometry.extents()[0];
        let mut results = Vec::new();
        for row in 0..geometry.cells() / width {
            let values = group.values(substate.field, row * width..(row + 1) * width);
            append_row(reduction, stored, &values, &mut results);
        }
        Ok(ReducedRows { components: stored.components(), results })
    }

    fn memory(&self) -> usize {
        self.groups.iter().map(GroupState::memory).sum()
    }
}

impl ReferenceExecution {
    /// All cells.
    fn cells(&self) -> Range<usize> {
        0..self.model.geometry().cells()
    }
}

impl GroupState {
    /// The values of a field in a range of cells; of items, those in occupied slots.
    fn values(&self, field: usize, cells: Range<usize>) -> Vec<u8> {
        let places = cells.flat_map(|cell| {
            let first = cell * self.slots;
            let count = if self.is_population() { self.counts[cell] as usize } else { 1 };
            first..first + count
        });
        places.flat_map(|place| self.value(field, place)).copied().collect()
    }

    fn memory(&self) -> usize {
        let planes: usize = self.planes.iter().map(crate::storage::Buffer::capacity).sum();
        planes + (self.counts.capacity() + self.labels.capacity()) * size_of::<u32>()
    }
}
