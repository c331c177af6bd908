//! The state of a model on this engine.

use crate::blocks::blocks;
use crate::dense::Plane;
use crate::layout::Layout;
use crate::migration;
use crate::population::Population;
use crate::rows::{self, Group};
use crate::stages::{Stage, is_doubled, is_read_elsewhere, stages};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;
use xca_core::engine::{
    EngineFailure, Execution, Fault, Interruption, Population as Items, StartError, StepContext, SubstateId,
    Workers, step_by_step,
};
use xca_core::model::{Group as Definition, GroupKind};
use xca_core::reduction::{Reduced, Reduction, append_row, combine_rows};
use xca_core::{Model, Precision, ProcessKind, StoredType};

/// A model under way.
pub(crate) struct CpuExecution {
    model: Model,
    precision: Precision,
    pool: Arc<rayon::ThreadPool>,
    layout: Layout,
    groups: Vec<Group>,
    /// The stages of a whole step.
    stages: Vec<Stage>,
}

impl CpuExecution {
    pub(crate) fn new(
        model: &Model,
        precision: Precision,
        pool: Arc<rayon::ThreadPool>,
    ) -> Result<Self, StartError> {
        let layout = Layout::new(model.geometry());
        check_size(model, &layout, precision)?;
        let groups = model.groups().iter().enumerate();
        let groups = pool.install(|| {
            groups.map(|(number, group)| state(model, number, group, &layout, precision)).collect()
        });
        let stages = stages(model, 0..model.processes().len());
        Ok(Self { model: model.clone(), precision, pool, layout, groups, stages })
    }

    fn run_stage(&mut self, stage: &Stage, context: &StepContext<'_>) -> Result<(), Fault> {
        let movers = rows::run(
            &self.model,
            &self.layout,
            self.precision,
            &mut self.groups,
            stage.processes.clone(),
            context,
        )?;
        // A migration is the last of its stage.
        let Some(process) = self.model.processes()[stage.processes.clone()].last() else { return Ok(()) };
        if process.kind == ProcessKind::Migration
            && let Some(number) = self.model.group_number((process.subject.type_id)())
            && let Group::Population(population) = &mut self.groups[number]
        {
            migration::migrate(population, &self.layout, self.model.geometry(), process, &movers)?;
        }
        Ok(())
    }
}

fn check_size(model: &Model, layout: &Layout, precision: Precision) -> Result<(), StartError> {
    let too_large = |what: &str, wanted: u128, limit: u128| StartError::TooLarge {
        engine: "cpu".to_owned(),
        what: what.to_owned(),
        wanted,
        limit,
    };
    let cells = layout.checked_cells().unwrap_or(usize::MAX) as u128;
    let bytes = least_memory(model, layout, precision).max(cells);
    if bytes > 1 << 45 { Err(too_large("the bytes of the state", bytes, 1 << 45)) } else { Ok(()) }
}

/// The bytes of a model without items: planes, some of them twice, and the ranges of the cells' items.
pub(crate) fn least_memory(model: &Model, layout: &Layout, precision: Precision) -> u128 {
    let of_field = |group: usize, (field, stored): (usize, StoredType)| {
        let planes = if is_doubled(model, SubstateId { group, field }) { 2 } else { 1 };
        planes * stored.size()
    };
    let of_group = |(number, group): (usize, &Definition)| match group.kind() {
        GroupKind::Cells { .. } => {
            group.stored(precision).into_iter().enumerate().map(|field| of_field(number, field)).sum()
        }
        GroupKind::Population { .. } => 2 * size_of::<u32>(),
    };
    let size: usize = model.groups().iter().enumerate().map(of_group).sum();
    layout.checked_cells().unwrap_or(usize::MAX) as u128 * size as u128
}

fn state(model: &Model, number: usize, group: &Definition, layout: &Layout, precision: Precision) -> Group {
    let types = group.stored(precision);
    match group.kind() {
        GroupKind::Cells { outside } => Group::Cells(
            types
                .into_iter()
                .enumerate()
                .map(|(field, stored)| {
                    let mut bytes = vec![0; stored.size()];
                    outside(field, precision, &mut bytes);
                    let substate = SubstateId { group: number, field };
                    let (doubled, elsewhere) =
                        (is_doubled(model, substate), is_read_elsewhere(model, substate));
                    Plane::new(stored, layout, &bytes, doubled, elsewhere)
                })
                .collect(),
        ),
        GroupKind::Population { slots, may_leave } => {
            Group::Population(Population::new(types, *slots, *may_leave, layout))
        }
    }
}

impl Execution for CpuExecution {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        let whole = processes == (0..self.model.processes().len());
        let stages = if whole { self.stages.clone() } else { stages(&self.model, processes) };
        // Parallel iterators run on the pool that they are started in.
        let pool = Arc::clone(&self.pool);
        pool.install(|| stages.iter().try_for_each(|stage| self.run_stage(stage, context)))
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        let processes = self.model.processes().len();
        step_by_step(steps, context, |context| self.run(0..processes, context))
    }

    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        Ok(match &self.groups[substate.group] {
            Group::Cells(planes) => planes[substate.field].read(&self.layout),
            Group::Population(population) => population.items.fields[substate.field].bytes().to_vec(),
        })
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        match &mut self.groups[substate.group] {
            Group::Cells(planes) => planes[substate.field].write(&self.layout, values),
            Group::Population(population) => {
                population.items.fields[substate.field].bytes_mut().copy_from_slice(values);
            }
        }
        Ok(())
    }

    fn read_cell(&self, substate: SubstateId, cell: usize) -> Result<Vec<u8>, EngineFailure> {
        Ok(match &self.groups[substate.group] {
            Group::Cells(planes) => planes[substate.field].cell(&self.layout, cell).to_vec(),
            Group::Population(_) => Vec::new(),
        })
    }

    fn write_cell(&mut self, substate: SubstateId, cell: usize, value: &[u8]) -> Result<(), EngineFailure> {
        if let Group::Cells(planes) = &mut self.groups[substate.group] {
            planes[substate.field].write_cell(&self.layout, cell, value);
        }
        Ok(())
    }

    fn population(&self, group: usize) -> Result<Items, EngineFailure> {
        Ok(match &self.groups[group] {
            Group::Cells(_) => Items::default(),
            Group::Population(population) => Items {
                counts: (0..self.layout.rows())
                    .flat_map(|row| population.counts(&self.layout, row))
                    .collect(),
                labels: population.items.labels.clone(),
                fields: population.items.fields.iter().map(|field| field.bytes().to_vec()).collect(),
            },
        })
    }

    fn set_population(&mut self, group: usize, items: &Items) -> Result<(), Fault> {
        if let Group::Population(population) = &mut self.groups[group] {
            if let Some(cell) = items.counts.iter().position(|count| *count as usize > population.slots) {
                return Err(Fault::CellFull {
                    process: None,
                    cell: self.model.geometry().indices(cell),
                    items: items.counts[cell] as usize,
                    slots: population.slots,
                });
            }
            self.pool.install(|| population.set(&self.layout, items));
        }
        Ok(())
    }

    fn items(&self, group: usize) -> usize {
        match &self.groups[group] {
            Group::Cells(_) => 0,
            Group::Population(population) => population.count(),
        }
    }

    fn left(&self, group: usize) -> u64 {
        match &self.groups[group] {
            Group::Cells(_) => 0,
            Group::Population(population) => population.left,
        }
    }

    fn largest_occupancy(&self, group: usize) -> Result<u32, EngineFailure> {
        Ok(match &self.groups[group] {
            Group::Cells(_) => 0,
            Group::Population(population) => (0..self.layout.rows())
                .filter(|row| population.row(*row).0 < population.row(*row).1)
                .flat_map(|row| population.counts(&self.layout, row))
                .max()
                .unwrap_or(0),
        })
    }

    fn reduce(&self, substate: SubstateId, reduction: &Reduction) -> Result<Vec<Reduced>, EngineFailure> {
        let stored = self.model.stored(substate, self.precision);
        let row = |row: usize, results: &mut Vec<Reduced>| match &self.groups[substate.group] {
            Group::Cells(planes) => {
                append_row(reduction, stored, planes[substate.field].row(&self.layout, row), results);
            }
            // Most rows may be empty.
            Group::Population(population) => match population.row(row) {
                (first, end) if first == end => {}
                (first, end) => {
                    let values = population.items.fields[substate.field].bytes();
                    append_row(
                        reduction,
                        stored,
                        &values[first * stored.size()..end * stored.size()],
                        results,
                    );
                }
            },
        };
        let reduce = |rows: &Range<usize>| {
            let mut results = Vec::new();
            rows.clone().for_each(|number| row(number, &mut results));
            results
        };
        let parts: Vec<Vec<Reduced>> = self.pool.install(|| {
            let populations: Vec<&Population> = match &self.groups[substate.group] {
                Group::Cells(_) => Vec::new(),
                Group::Population(population) => vec![population],
            };
            blocks(&self.layout, &populations, rayon::current_num_threads()).par_iter().map(reduce).collect()
        });
        let lanes = usize::from(stored.lanes);
        Ok(combine_rows(reduction, lanes, parts.iter().flat_map(|part| part.chunks_exact(lanes))))
    }

    fn workers(&self) -> Option<Arc<dyn Workers>> {
        Some(Arc::new(Pool(Arc::clone(&self.pool))))
    }

    fn memory(&self) -> usize {
        self.groups
            .iter()
            .map(|group| match group {
                Group::Cells(planes) => planes.iter().map(Plane::memory).sum(),
                Group::Population(population) => population.memory(),
            })
            .sum()
    }
}

/// The engine's threads.
struct Pool(Arc<rayon::ThreadPool>);

impl Workers for Pool {
    fn run(&self, work: &mut (dyn FnMut() + Send)) {
        self.0.install(work);
    }
}
