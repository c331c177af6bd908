//! The state as simulations ask for it.

use crate::device::{Binding, DeviceError};
use crate::execution::{GpuExecution, failure};
use crate::groups::Group;
use crate::reduction::{self, Rows};
use crate::service::{OCCUPANCY, Services};
use std::ops::Range;
use xca_core::engine::{
    EngineFailure, Execution, Fault, Interruption, Population as Items, StepContext, SubstateId,
};
use xca_core::reduction::{ITEMS_IN_BLOCK, Reduced, Reduction, reduce_values};

impl Execution for GpuExecution {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        self.run_processes(processes, context)
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        self.steps(steps, context)
    }

    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        let plane = self.groups.plane(substate);
        match self.groups.group(substate.group) {
            Group::Cells(_) => plane.read_cells(&self.device, &self.space),
            Group::Population(population) => plane.read_items(&self.device, population.items),
        }
        .map_err(|error| failure(&error))
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        let plane = self.groups.plane(substate);
        match self.groups.group(substate.group) {
            Group::Cells(_) => {
                let outside = self.outside(substate);
                plane.write_cells(&self.device, &self.space, self.halo.cells(), &outside, values)
            }
            Group::Population(_) => plane.write_items(&self.device, values),
        }
        .map_err(|error| failure(&error))
    }

    fn read_cell(&self, substate: SubstateId, cell: usize) -> Result<Vec<u8>, EngineFailure> {
        let number = self.space.number(self.space.geometry().indices(cell));
        self.groups.plane(substate).read_cell(&self.device, number).map_err(|error| failure(&error))
    }

    fn write_cell(&mut self, substate: SubstateId, cell: usize, value: &[u8]) -> Result<(), EngineFailure> {
        self.set_cell(substate, cell, value).map_err(|error| failure(&error))
    }

    fn population(&self, group: usize) -> Result<Items, EngineFailure> {
        let Some(population) = self.groups.population(group) else { return Ok(Items::default()) };
        population.get(&self.device, &self.space).map_err(|error| failure(&error))
    }

    fn set_population(&mut self, group: usize, items: &Items) -> Result<(), Fault> {
        let Some(population) = self.groups.population_mut(group) else { return Ok(()) };
        let slots = population.slots;
        if let Some(cell) = items.counts.iter().position(|count| *count as usize > slots) {
            let cell_of = self.space.geometry().indices(cell);
            return Err(Fault::CellFull {
                process: None,
                cell: cell_of,
                items: items.counts[cell] as usize,
                slots,
            });
        }
        population
            .set(&self.device, &self.space, self.halo.cells(), items)
            .and_then(|()| self.items_changed(group))
            .map_err(|error| failure(&error).into())
    }

    fn items(&self, group: usize) -> usize {
        self.groups.items(group)
    }

    fn left(&self, group: usize) -> u64 {
        self.groups.population(group).map_or(0, |population| population.left)
    }

    fn largest_occupancy(&self, group: usize) -> Result<u32, EngineFailure> {
        self.occupancy(group).map_err(|error| failure(&error))
    }

    fn reduce(&self, substate: SubstateId, reduction: &Reduction) -> Result<Vec<Reduced>, EngineFailure> {
        let stored = self.model.stored(substate, self.manner.precision);
        let rows = if reduction::is_possible(&self.device, reduction, stored) {
            self.reduce_here(substate, reduction).map_err(|error| failure(&error))?
        } else {
            let of_cells = self.groups.of_cells(substate);
            let width = if of_cells { self.space.geometry().extents()[0] } else { ITEMS_IN_BLOCK };
            let values = self.read(substate)?;
            values
                .chunks(width * stored.size())
                .map(|values| reduce_values(reduction, stored, values))
                .collect()
        };
        let mut results = vec![Reduced::Nothing; stored.components()];
        for row in rows {
            for (result, part) in results.iter_mut().zip(row) {
                *result = result.combine(part, reduction);
            }
        }
        Ok(results)
    }

    fn memory(&self) -> usize {
        let migrations = self.migrations.iter().map(crate::migration::Migration::memory);
        self.groups.memory() + self.halo.memory() + migrations.sum::<usize>()
    }
}

impl GpuExecution {
    fn set_cell(&mut self, substate: SubstateId, cell: usize, value: &[u8]) -> Result<(), DeviceError> {
        let number = self.space.number(self.space.geometry().indices(cell));
        let plane = self.groups.plane(substate);
        plane.write_cell(&self.device, number, value)?;
        let mut recorder = self.device.recorder();
        self.halo.fill(&self.device, &mut recorder, &mut self.services, plane)?;
        self.device.submit(recorder)
    }

    fn occupancy(&self, group: usize) -> Result<u32, DeviceError> {
        let Some(population) = self.groups.population(group) else { return Ok(0) };
        let (device, rows) = (&self.device, self.space.rows());
        let description = crate::migration::description(&self.space, population);
        let space = device.uniform("space", bytemuck::cast_slice(&description))?;
        let length = (rows * size_of::<u32>()) as u64;
        let results = device.buffer("results", length)?;
        let parts =
            [(&space).into(), (&population.starts).into(), (&population.ends).into(), (&results).into()];
        let mut recorder = device.recorder();
        Services::default().run(device, &mut recorder, OCCUPANCY, (&[], &parts), rows)?;
        device.submit(recorder)?;
        let bytes = device.download(&results, 0..length)?;
        Ok(bytemuck::pod_collect_to_vec::<u8, u32>(&bytes).into_iter().max().unwrap_or(0))
    }

    /// The reduced rows, or blocks of items, made on the device.
    fn reduce_here(
        &self,
        substate: SubstateId,
        reduction: &Reduction,
    ) -> Result<Vec<Vec<Reduced>>, DeviceError> {
        let stored = self.model.stored(substate, self.manner.precision);
        let plane = self.groups.plane(substate);
        let reduce = |values: Binding, rows: Rows| {
            reduction::reduce(&self.device, self.manner.strict, (reduction, stored), values, rows)
        };
        if let Group::Population(population) = self.groups.group(substate.group) {
            let (items, width) = (population.items as u32, ITEMS_IN_BLOCK as u32);
            if items == 0 {
                return Ok(Vec::new());
            }
            let rows = items.div_ceil(width);
            let blocks =
                Rows { rows, width, values: items, height: rows, first: 0, row: width, layer: 0, unused: 0 };
            return reduce(plane.now().into(), blocks);
        }
        let mut all = Vec::new();
        for part in self.space.parts() {
            let [width, height, depth] = part.count.map(|count| count as u32);
            let rows = height * depth;
            let values = width.saturating_mul(rows);
            let first = (self.space.number(part.first) - part.base) as u32;
            let (row, layer) = (self.space.row() as u32, self.space.layer() as u32);
            let rows = Rows { rows, width, values, height, first, row, layer, unused: 0 };
            all.extend(reduce(plane.part(plane.now(), part), rows)?);
        }
        Ok(all)
    }
}
