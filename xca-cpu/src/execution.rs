//! The state of a model on this engine.

use crate::activity::Activity;
use crate::blocks::blocks;
use crate::choices::Choices;
use crate::dense::Dense;
use crate::edges::Edges;
use crate::group::{Group, groups};
use crate::layout::Layout;
use crate::memory::check_size;
use crate::migration;
use crate::population::Population;
use crate::reductions::{Reductions, reduce_row};
use crate::row_counts::RowCounts;
use crate::rows::{self, FirstFault, Ground, Mover, StageOfStep};
use crate::stages::{Stage, stages};
use crate::stride::Stride;
use crate::threads::Threads;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use xca_core::engine::{
    Border, EngineFailure, Execution, Fault, Figure, InputError, Interruption, Part, Plane,
    Population as Items, RowWork, StartError, StepContext, SubstateId, Workers, check_cells,
    check_cells_of_part, check_plane, check_population_of_part, check_substate, check_values,
    check_values_of_cells, check_values_of_part, check_values_of_rows,
};
use xca_core::reduction::{Reduced, ReducedRows, Reduction, append_row};
use xca_core::{Model, Precision, ProcessKind};

/// A running model.
pub(crate) struct CpuExecution {
    pub(crate) model: Model,
    pub(crate) precision: Precision,
    pub(crate) threads: Threads,
    pub(crate) layout: Layout,
    /// The own part of the space. `None` for the whole space.
    pub(crate) edges: Option<Edges>,
    pub(crate) groups: Vec<Group>,
    /// The tiles in which processes over cells are due. `None` for a model without such processes.
    pub(crate) activity: Option<Activity>,
    pub(crate) stride: Stride,
    reductions: Mutex<Reductions>,
    /// The stages of a step in which all processes run.
    stages: Vec<Stage>,
    /// The work of each row. `None` for the whole space.
    pub(crate) counts: Option<RowCounts>,
}

impl CpuExecution {
    pub(crate) fn new(
        model: &Model,
        precision: Precision,
        threads: Threads,
        choices: Choices,
        shared: Option<(Part, Box<dyn Border>)>,
    ) -> Result<Self, StartError> {
        let geometry = model.geometry();
        let layout = shared
            .as_ref()
            .map_or_else(|| Layout::new(geometry), |(part, _)| Layout::of_part(geometry, part));
        check_size(model, &layout, precision)?;
        let edges = shared.map(|(part, border)| Edges::new(model, &layout, part, border));
        let groups = threads.run(|| groups(model, &layout, precision, choices.skin));
        let stages = stages(model, 0..model.processes().len());
        let stride = Stride::new((model, &layout, precision), stages.len(), threads.count(), choices);
        let activity = Activity::new(model, &layout, choices.leave_out);
        let counts = edges.as_ref().map(|_| RowCounts::new(layout.rows(), layout.width()));
        Ok(Self {
            model: model.clone(),
            precision,
            threads,
            layout,
            edges,
            groups,
            activity,
            stride,
            reductions: Mutex::default(),
            stages,
            counts,
        })
    }

    /// Runs those of these processes that are due in the step, with the parameters that the engine has.
    fn run_step(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        let stages = self.due_stages(processes, context);
        let threads = self.threads.clone();
        let leaves_out = self.leaves_out();
        threads.run(|| stages.iter().try_for_each(|stage| self.run_stage(stage, leaves_out, context)))
    }

    /// The stages of those of these processes that are due in the step.
    pub(crate) fn due_stages(&self, processes: Range<usize>, context: &StepContext<'_>) -> Vec<Stage> {
        let all = self.model.processes();
        let whole = processes == (0..all.len()) && all.iter().all(|process| process.is_due(context.step));
        let due = processes.filter(|number| all[*number].is_due(context.step));
        if whole { self.stages.clone() } else { stages(&self.model, due) }
    }

    /// Ends steps, the last of which may have a fault.
    pub(crate) fn end_steps(&mut self, steps: u64, time: Duration, is_faulty: bool) {
        if let Some(activity) = &mut self.activity {
            activity.end_steps(steps, time);
            if is_faulty {
                activity.wake();
            }
        }
    }

    /// Whether processes run only where they are due.
    pub(crate) fn leaves_out(&self) -> bool {
        self.activity.as_ref().is_some_and(Activity::is_on)
    }

    fn check_own(&self, cells: &[usize]) -> Result<(), InputError> {
        self.edges.as_ref().map_or(Ok(()), |edges| check_cells_of_part(&self.model, &edges.part, cells))
    }

    fn take_parameters(&mut self, context: &StepContext<'_>) {
        if let Some(activity) = &mut self.activity {
            activity.take_parameters(context.values);
        }
    }

    fn run_stage(
        &mut self,
        stage: &[usize],
        leaves_out: bool,
        context: &StepContext<'_>,
    ) -> Result<(), Fault> {
        let mut movers = self.run_rows(stage, leaves_out, context).map_err(|first| first.fault)?;
        if let Some((number, group)) = self.migration(stage)
            && let Group::Population(population) = &mut self.groups[group]
        {
            let process = &self.model.processes()[number];
            migration::migrate(population, &self.layout, self.model.geometry(), process, &mut movers)?;
        }
        Ok(())
    }

    /// The migration of a stage, which is its last process, and the index of its population.
    pub(crate) fn migration(&self, stage: &[usize]) -> Option<(usize, usize)> {
        let &last = stage.last()?;
        let migrates = self.model.processes()[last].kind == ProcessKind::Migration;
        Some((last, self.model.plan().process(last).population?)).filter(|_| migrates)
    }

    /// Runs the processes of a stage over all rows.
    fn run_rows(
        &mut self,
        stage: &[usize],
        leaves_out: bool,
        context: &StepContext<'_>,
    ) -> Result<Vec<Mover>, FirstFault> {
        if let Some(activity) = &mut self.activity
            && !leaves_out
        {
            activity.worked_on_all(stage);
        }
        let activity = self.activity.as_mut().filter(|_| leaves_out);
        let ground = Ground { model: &self.model, layout: &self.layout, precision: self.precision };
        let stage = StageOfStep { processes: stage, context: *context };
        rows::run(ground, &mut self.groups, stage, activity, None)
    }

    /// The number of steps to do together next, out of `left`.
    pub(crate) fn together(&self, left: u64) -> u64 {
        let free = self.activity.as_ref().map_or(u64::MAX, Activity::steps_without);
        self.stride.steps(left.min(free)).max(1)
    }

    /// The passes of `steps` steps that are done together. All work on all cells.
    pub(crate) fn passes_together<'a>(
        &mut self,
        steps: u64,
        context: &StepContext<'a>,
    ) -> Vec<(StepContext<'a>, Stage)> {
        let contexts = (0..steps).map(|done| StepContext { step: context.step + done, ..*context });
        let all = 0..self.model.processes().len();
        let due = contexts.flat_map(|context| {
            let is_due = |number: &usize| self.model.processes()[*number].is_due(context.step);
            stages(&self.model, all.clone().filter(is_due)).into_iter().map(move |stage| (context, stage))
        });
        let due: Vec<(StepContext<'_>, Stage)> = due.collect();
        if let Some(activity) = &mut self.activity {
            due.iter().for_each(|(_, stage)| activity.worked_on_all(stage));
        }
        due
    }

    /// Does `steps` steps together: all processes in all cells.
    fn run_together(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        let due = self.passes_together(steps, context);
        let stages: Vec<StageOfStep<'_>> = due.iter().map(StageOfStep::new).collect();
        let ground = Ground { model: &self.model, layout: &self.layout, precision: self.precision };
        let groups = &mut self.groups;
        let depth = self.stride.depth(stages.len());
        let result = self.threads.run(|| rows::run_in_wake(ground, groups, &stages, depth));
        result.map_err(|first| Interruption {
            done: stages[first.pass].context.step - context.step,
            fault: first.fault,
        })
    }
}

impl Execution for CpuExecution {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        self.take_parameters(context);
        if self.edges.is_some() {
            return self.run_in_part(processes, 1, context).map_err(|stopped| stopped.fault);
        }
        let start = Instant::now();
        let result = self.run_step(processes, context);
        self.end_steps(1, start.elapsed(), result.is_err());
        result
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        let processes = self.model.processes().len();
        self.take_parameters(context);
        if self.edges.is_some() {
            return self.run_in_part(0..processes, steps, context);
        }
        let mut done = 0;
        while done < steps {
            let context = StepContext { step: context.step + done, ..*context };
            let together = self.together(steps - done);
            let leaves_out = self.leaves_out();
            let start = Instant::now();
            let result = match together {
                1 => self.run_step(0..processes, &context).map_err(|fault| Interruption { done: 0, fault }),
                _ => self.run_together(together, &context),
            };
            let time = start.elapsed();
            if !leaves_out {
                self.stride.took(together, time);
            }
            self.end_steps(together, time, result.is_err());
            result.map_err(|stopped| Interruption { done: done + stopped.done, ..stopped })?;
            done += together;
        }
        Ok(())
    }

    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        check_substate(&self.model, substate)?;
        Ok(match &self.groups[substate.group] {
            Group::Cells(planes) => planes[substate.field].read(&self.layout),
            Group::Population(population) => population.read(substate.field),
        })
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        match (&self.edges, self.groups.get(substate.group)) {
            (Some(edges), Some(Group::Cells(_))) => {
                check_values_of_part(&self.model, self.precision, substate, &edges.part, values)?;
            }
            _ => check_values(&self.model, self.precision, substate, self.items(substate.group), values)?,
        }
        if let Some(activity) = &mut self.activity {
            activity.replaced(substate);
        }
        match &mut self.groups[substate.group] {
            Group::Cells(planes) => {
                planes[substate.field].write_rows(&self.layout, 0..self.layout.rows(), values);
            }
            Group::Population(population) => population.write(substate.field, values),
        }
        Ok(())
    }

    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure> {
        check_cells(&self.model, substate, cells)?;
        self.check_own(cells)?;
        Ok(match &self.groups[substate.group] {
            Group::Cells(planes) => planes[substate.field].read_cells(&self.layout, cells),
            Group::Population(_) => Vec::new(),
        })
    }

    fn write_cells(
        &mut self,
        substate: SubstateId,
        cells: &[usize],
        values: &[u8],
    ) -> Result<(), EngineFailure> {
        check_values_of_cells(&self.model, self.precision, substate, cells, values)?;
        self.check_own(cells)?;
        if let Group::Cells(planes) = &mut self.groups[substate.group] {
            planes[substate.field].write_cells(&self.layout, cells, values);
            if let Some(activity) = &mut self.activity {
                activity.replaced_in(substate, cells);
            }
        }
        Ok(())
    }

    fn read_rows(&self, plane: Plane, rows: Range<usize>) -> Result<Option<Vec<u8>>, EngineFailure> {
        check_plane(&self.model, plane)?;
        let (own, mut bytes) = (self.layout.rows_within(rows), Vec::new());
        match (&self.groups[plane.group()], plane) {
            (Group::Population(population), plane) => {
                population.read_rows((&self.layout, plane), own, &mut bytes);
            }
            (Group::Cells(planes), Plane::Values(SubstateId { field, .. })) => {
                planes[field].read_rows(&self.layout, own, &mut bytes);
            }
            // The check refuses counts and labels of cells.
            (Group::Cells(_), _) => {}
        }
        Ok(Some(bytes))
    }

    fn write_rows(
        &mut self,
        substate: SubstateId,
        rows: Range<usize>,
        values: &[u8],
    ) -> Result<bool, EngineFailure> {
        let own = self.layout.rows_within(rows);
        check_values_of_rows(&self.model, self.precision, substate, own.clone().count(), values)?;
        if let Some(activity) = &mut self.activity {
            activity.replaced(substate);
        }
        if let Group::Cells(planes) = &mut self.groups[substate.group] {
            planes[substate.field].write_rows(&self.layout, own, values);
        }
        Ok(true)
    }

    fn population(&self, group: usize) -> Result<Items, EngineFailure> {
        Ok(match &self.groups[group] {
            Group::Cells(_) => Items::default(),
            Group::Population(population) => Items {
                counts: (0..self.layout.rows())
                    .flat_map(|row| population.counts(&self.layout, row))
                    .collect(),
                labels: population.labels(),
                fields: (0..population.types.len()).map(|field| population.read(field)).collect(),
            },
        })
    }

    fn set_population(&mut self, group: usize, items: &Items) -> Result<(), Fault> {
        let geometry = self.model.geometry();
        let part = self.edges.as_ref().map_or_else(|| Part::whole(geometry), |edges| edges.part.clone());
        check_population_of_part(&self.model, self.precision, group, &part, items)?;
        if let Group::Population(population) = &mut self.groups[group] {
            self.threads.run(|| population.set(&self.layout, items));
        }
        Ok(())
    }

    fn items(&self, group: usize) -> usize {
        match self.groups.get(group) {
            Some(Group::Population(population)) => population.count(),
            _ => 0,
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

    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure> {
        check_substate(&self.model, substate)?;
        let stored = self.model.stored(substate, self.precision);
        let (groups, layout) = (&self.groups, &self.layout);
        if let Group::Cells(planes) = &groups[substate.group]
            && let Some(activity) = self.activity.as_ref().filter(|activity| activity.is_on())
        {
            let dense = (substate, &planes[substate.field]);
            let mut reductions = self.reductions.lock().unwrap_or_else(PoisonError::into_inner);
            let reductions = &mut *reductions;
            return Ok(self.threads.run(|| reductions.reduce(dense, layout, activity, reduction)));
        }
        let row = |row: usize, results: &mut Vec<Reduced>| match &groups[substate.group] {
            Group::Cells(planes) => reduce_row(&planes[substate.field], layout, row, reduction, results),
            Group::Population(population) => {
                let (first, end) = population.row(row);
                let values = population.items.fields[substate.field].bytes();
                append_row(reduction, stored, &values[first * stored.size()..end * stored.size()], results);
            }
        };
        let reduce = |rows: &Range<usize>| {
            let mut results = Vec::new();
            rows.clone().for_each(|number| row(number, &mut results));
            results
        };
        let parts: Vec<Vec<Reduced>> = self.threads.run(|| {
            let populations: Vec<&Population> = match &groups[substate.group] {
                Group::Cells(_) => Vec::new(),
                Group::Population(population) => vec![population],
            };
            blocks(layout, &populations, rayon::current_num_threads()).par_iter().map(reduce).collect()
        });
        Ok(ReducedRows { components: stored.components(), results: parts.concat() })
    }

    fn figures(&self) -> Vec<Figure> {
        let groups = self.model.groups().iter().zip(&self.groups);
        let figures = groups.filter_map(|(definition, group)| match group {
            Group::Population(population) => {
                Some(population.upkeep.figures().named(definition.schema().name))
            }
            Group::Cells(_) => None,
        });
        let of_cells =
            self.activity.as_ref().and_then(Activity::figure).into_iter().chain(self.stride.figure());
        figures.flatten().chain(of_cells).collect()
    }

    fn work(&self) -> RowWork {
        self.counts.as_ref().map_or_else(RowWork::default, |counts| counts.work(self.activity.as_ref()))
    }

    fn workers(&self) -> Option<Arc<dyn Workers>> {
        // A part waits for other parts, which may share its threads.
        self.edges.is_none().then(|| Arc::new(self.threads.clone()) as Arc<dyn Workers>)
    }

    fn memory(&self) -> usize {
        self.groups
            .iter()
            .map(|group| match group {
                Group::Cells(planes) => planes.iter().map(Dense::memory).sum(),
                Group::Population(population) => population.memory(),
            })
            .sum()
    }
}
