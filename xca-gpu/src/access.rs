//! The state as simulations ask for it.

use crate::activity::Activity;
use crate::device::DeviceError;
use crate::edges::Edges;
use crate::error::failure;
use crate::execution::GpuExecution;
use crate::groups::Group;
use crate::reduction::{self, Rows, Values};
use crate::service::{OCCUPANCY, Services};
use std::ops::Range;
use xca_core::engine::{
    EngineFailure, Execution, Fault, Figure, Interruption, Population as Items, StepContext, SubstateId,
    check_cells, check_population, check_substate, check_values, check_values_of_cells, check_values_of_part,
};
use xca_core::reduction::{Reduced, ReducedRows, Reduction, append_row};

impl Execution for GpuExecution {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        self.run_processes(processes, context)
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        self.steps(steps, context)
    }

    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        check_substate(&self.model, substate)?;
        let plane = self.groups.plane(substate);
        match self.groups.group(substate.group) {
            Group::Cells(_) => plane.read_space(&self.device, &self.space),
            Group::Population(population) => plane.read_items(&self.device, population.items),
        }
        .map_err(|error| failure(&error))
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        let (model, precision) = (&self.model, self.manner.precision);
        match self.edges {
            Some(_) => check_values_of_part(model, precision, substate, self.space.part(), values)?,
            None => check_values(model, precision, substate, self.items(substate.group), values)?,
        }
        self.others_change(substate);
        self.forget_activity().map_err(|error| failure(&error))?;
        let plane = self.groups.plane(substate);
        match self.groups.group(substate.group) {
            Group::Cells(_) => {
                let outside = self.outside(substate);
                plane.write_space(&self.device, &self.space, self.halo.cells(), &outside, values)
            }
            Group::Population(_) => plane.write_items(&self.device, values),
        }
        .map_err(|error| failure(&error))
    }

    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure> {
        check_cells(&self.model, substate, cells)?;
        self.check_own(cells)?;
        let plane = self.groups.plane(substate);
        plane.read_cells(&self.device, &self.numbers(cells)).map_err(|error| failure(&error))
    }

    fn write_cells(
        &mut self,
        substate: SubstateId,
        cells: &[usize],
        values: &[u8],
    ) -> Result<(), EngineFailure> {
        check_values_of_cells(&self.model, self.manner.precision, substate, cells, values)?;
        self.check_own(cells)?;
        self.others_change(substate);
        self.forget_activity().map_err(|error| failure(&error))?;
        self.set_cells(substate, cells, values).map_err(|error| failure(&error))
    }

    fn population(&self, group: usize) -> Result<Items, EngineFailure> {
        let Some(population) = self.groups.population(group) else { return Ok(Items::default()) };
        population.get(&self.device, &self.space).map_err(|error| failure(&error))
    }

    fn set_population(&mut self, group: usize, items: &Items) -> Result<(), Fault> {
        check_population(&self.model, self.manner.precision, group, items)?;
        let Some(population) = self.groups.population_mut(group) else { return Ok(()) };
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

    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure> {
        check_substate(&self.model, substate)?;
        let stored = self.model.stored(substate, self.manner.precision);
        let longest_row = match self.groups.group(substate.group) {
            Group::Cells(_) => self.space.extents()[0],
            Group::Population(population) => population.items,
        };
        let results = if reduction::is_possible(&self.device, (reduction, stored), longest_row) {
            self.reduce_here(substate, reduction).map_err(|error| failure(&error))?
        } else {
            let lengths = match self.groups.group(substate.group) {
                Group::Cells(_) => vec![self.space.extents()[0]; self.space.rows()],
                Group::Population(population) => {
                    population.row_lengths(&self.device, &self.space).map_err(|error| failure(&error))?
                }
            };
            let values = self.read(substate)?;
            let mut rest = values.as_slice();
            let mut results = Vec::new();
            for length in lengths {
                let (row, others) = rest.split_at(length * stored.size());
                rest = others;
                append_row(reduction, stored, row, &mut results);
            }
            results
        };
        Ok(ReducedRows { components: stored.components(), results })
    }

    fn memory(&self) -> usize {
        let migrations = self.migrations.iter().map(crate::migration::Migration::memory);
        let activity = self.activity.as_ref().map_or(0, Activity::memory);
        let edges = self.edges.as_ref().map_or(0, Edges::memory);
        self.groups.memory() + self.halo.memory() + migrations.sum::<usize>() + activity + edges
    }

    fn figures(&self) -> Vec<Figure> {
        let share = self.activity.as_ref().and_then(Activity::share);
        let figure = |value| Figure { name: "share_of_cells_worked_on".to_owned(), value };
        share.map(figure).into_iter().collect()
    }
}

impl GpuExecution {
    /// The stored numbers of cells.
    fn numbers(&self, cells: &[usize]) -> Vec<usize> {
        cells.iter().map(|cell| self.space.number(self.space.geometry().indices(*cell))).collect()
    }

    fn set_cells(&mut self, substate: SubstateId, cells: &[usize], values: &[u8]) -> Result<(), DeviceError> {
        let numbers = self.numbers(cells);
        let plane = self.groups.plane(substate);
        plane.write_cells(&self.device, &numbers, values)?;
        let mut recorder = self.device.recorder();
        self.halo.fill(&self.device, &mut recorder, &mut self.services, plane)?;
        self.device.submit(recorder)
    }

    fn occupancy(&self, group: usize) -> Result<u32, DeviceError> {
        let Some(population) = self.groups.population(group) else { return Ok(0) };
        let (device, rows) = (&self.device, self.space.rows());
        if !device.finishes(self.space.geometry().extents()[0] + 2) {
            return population.largest_occupancy(device);
        }
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

    /// The results of all rows, made on the device.
    fn reduce_here(&self, substate: SubstateId, reduction: &Reduction) -> Result<Vec<Reduced>, DeviceError> {
        let stored = self.model.stored(substate, self.manner.precision);
        let plane = self.groups.plane(substate);
        let reduce = |values: Values<'_>, rows: Rows| {
            reduction::reduce(&self.device, self.manner.strict, (reduction, stored), values, rows)
        };
        if let Group::Population(population) = self.groups.group(substate.group) {
            if population.items == 0 {
                return Ok(vec![Reduced::Nothing; self.space.rows() * stored.components()]);
            }
            let [width, height, depth] = self.space.geometry().extents();
            let whole = self.rows([width, height, depth], self.space.row_start(0));
            let ranges = [&population.starts, &population.ends];
            return reduce(Values::OfItems(plane.now().into(), ranges), whole);
        }
        let mut all = Vec::new();
        for section in self.space.sections() {
            let rows = self.rows(section.count, self.space.number(section.first) - section.base);
            all.extend(reduce(Values::OfCells(plane.section(plane.now(), section)), rows)?);
        }
        Ok(all)
    }

    /// The rows of so many cells along each axis, the first of which has this number.
    fn rows(&self, count: [usize; 3], first: usize) -> Rows {
        let [width, height, depth] = count.map(|count| count as u32);
        let (row, layer) = (self.space.row() as u32, self.space.layer() as u32);
        Rows { rows: height * depth, width, height, first: first as u32, row, layer }
    }
}
