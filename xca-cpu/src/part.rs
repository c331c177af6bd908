//! Steps in a part of a space.

use crate::crossing::{self, Departure, Migration};
use crate::edges::seen;
use crate::execution::CpuExecution;
use crate::ghosts;
use crate::group::Group;
use crate::rows::{self, Begun, FirstFault, Ground, Rows, StageOfStep};
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;
use xca_core::engine::{Interruption, Phase, STEPS_TO_AGREE, StepContext, Stopped, agree};

impl CpuExecution {
    /// Runs processes in some steps. All other parts do the same. They compare their faults now and then, and
    /// at the end.
    pub(crate) fn run_in_part(
        &mut self,
        processes: Range<usize>,
        steps: u64,
        context: &StepContext<'_>,
    ) -> Result<(), Interruption> {
        let mut done = 0;
        while done < steps {
            let first = StepContext { step: context.step + done, ..*context };
            let now = STEPS_TO_AGREE.min(steps - done);
            let stopped = self.run_steps_of_part(processes.clone(), now, &first).err();
            if let Some(edges) = &mut self.edges {
                let agreed = agree(&mut *edges.border, stopped);
                agreed.map_err(|stopped| Interruption { done: done + stopped.done, ..stopped })?;
            }
            done += now;
        }
        Ok(())
    }

    /// Runs those of these processes that are due in some steps. Returns the step in which this part stopped,
    /// from 0 for the first.
    fn run_steps_of_part(
        &mut self,
        processes: Range<usize>,
        steps: u64,
        context: &StepContext<'_>,
    ) -> Result<(), (u64, Stopped)> {
        let are_all = processes == (0..self.model.processes().len());
        let mut done = 0;
        while done < steps {
            let context = StepContext { step: context.step + done, ..*context };
            let together = if are_all { self.together(steps - done) } else { 1 };
            let leaves_out = self.leaves_out();
            let start = Instant::now();
            let result = match together {
                1 => self.run_step_of_part(processes.clone(), &context).map_err(|stopped| (0, stopped)),
                _ => self.run_together_in_part(together, &context),
            };
            let time = start.elapsed();
            if are_all && !leaves_out {
                self.stride.took(together, time);
            }
            self.end_steps(together, time, false);
            result.map_err(|(step, stopped)| (done + step, stopped))?;
            done += together;
        }
        Ok(())
    }

    /// Runs those of these processes that are due in the step.
    fn run_step_of_part(
        &mut self,
        processes: Range<usize>,
        context: &StepContext<'_>,
    ) -> Result<(), Stopped> {
        let stages = self.due_stages(processes, context);
        let leaves_out = self.leaves_out();
        stages.iter().try_for_each(|stage| self.run_stage_of_part(stage, leaves_out, context))
    }

    /// Does `steps` steps together, first in the layers that need nothing of other parts, then pass by pass
    /// at the borders. The messages are those of steps one by one, so other parts can do other numbers
    /// together.
    fn run_together_in_part(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), (u64, Stopped)> {
        let due = self.passes_together(steps, context);
        let passes: Vec<StageOfStep<'_>> = due.iter().map(StageOfStep::new).collect();
        let Self { model, precision, threads, layout, edges, groups, counts, stride, .. } = self;
        let Some(edges) = edges else { return Ok(()) };
        let ground = Ground { model, layout, precision: *precision };
        let depth = stride.depth(passes.len());
        let mut first_fault: Option<FirstFault> = None;
        for (number, pass) in passes.iter().enumerate() {
            let step = pass.context.step - context.step;
            let stopped = |failure| (step, Stopped::from(failure));
            let exchange = edges.begin((model, pass.processes), layout, threads, groups).map_err(stopped)?;
            if number == 0 {
                let result = threads.run(|| rows::run_within_borders(ground, groups, &passes, depth));
                first_fault = result.err();
            }
            if let Some(exchange) = exchange {
                edges.finish(&exchange, layout, threads, groups, None).map_err(stopped)?;
            }
            let result = threads.run(|| rows::run_at_borders(ground, groups, (*pass, number), depth));
            if let Some(counts) = counts {
                counts.ran(model, pass.processes, groups, false);
            }
            first_fault = first(first_fault, result.err());
            // Other parts still need the edges of all passes before the fault, to find earlier faults.
            if first_fault.as_ref().is_some_and(|fault| fault.pass == number) {
                break;
            }
        }
        first_fault
            .map_or(Ok(()), |fault| Err((passes[fault.pass].context.step - context.step, fault.into())))
    }

    fn run_stage_of_part(
        &mut self,
        stage: &[usize],
        leaves_out: bool,
        context: &StepContext<'_>,
    ) -> Result<(), Stopped> {
        let Overlap { begun, departure } = self.overlap(stage, leaves_out, context)?;
        let migration = self.migration(stage);
        let Self { model, precision, threads, layout, edges, groups, activity, counts, .. } = self;
        if let Some(activity) = activity
            && !leaves_out
        {
            activity.worked_on_all(stage);
        }
        let ground = Ground { model, layout, precision: *precision };
        let of_step = StageOfStep { processes: stage, context: *context };
        let followed = activity.as_mut().filter(|_| leaves_out);
        let result = threads.run(|| rows::run(ground, groups, of_step, followed, begun));
        if let Some(counts) = counts {
            counts.ran(model, stage, groups, leaves_out);
        }
        for group in seen(model, stage) {
            if let Group::Population(population) = &mut groups[group] {
                threads.run(|| ghosts::clear(population, layout));
            }
        }
        for found in stage.iter().flat_map(|&number| &model.plan().process(number).uses) {
            if found.written
                && let Group::Cells(planes) = &mut groups[found.substate.group]
            {
                planes[found.substate.field].others_wrote();
            }
        }
        let mut movers = result?;
        if let (Some((number, group)), Some(edges)) = (migration, edges)
            && let Group::Population(population) = &mut groups[group]
        {
            let process = &model.processes()[number];
            let migration = Migration { geometry: model.geometry(), process, number };
            crossing::migrate(migration, population, layout, (edges, threads), &mut movers, departure)?;
        }
        Ok(())
    }

    /// Runs those rows of a stage that can run while messages travel, and receives the edges of other parts.
    fn overlap(
        &mut self,
        stage: &[usize],
        leaves_out: bool,
        context: &StepContext<'_>,
    ) -> Result<Overlap, Stopped> {
        let migration = self.migration(stage);
        let Self { model, precision, threads, layout, edges, groups, activity, .. } = self;
        let Some(edges) = edges else { return Ok(Overlap::default()) };
        let ground = Ground { model, layout, precision: *precision };
        let of_step = StageOfStep { processes: stage, context: *context };
        let activity = activity.as_ref().filter(|_| leaves_out);
        let at_border = Arc::clone(&edges.at_border);
        let [has_outer, has_inner] = [true, false].map(|wanted| at_border.contains(&wanted));
        let begin = |groups: &mut [Group], wanted: bool| {
            let first = Rows { at_border, wanted };
            threads.run(|| rows::begin(ground, groups, of_step, activity, first))
        };
        if let Some(exchange) = edges.begin((model, stage), layout, threads, groups)? {
            let begun = has_inner.then(|| begin(groups, false));
            edges.finish(&exchange, layout, threads, groups, activity)?;
            return Ok(Overlap { begun, departure: None });
        }
        let Some((number, group)) = migration.filter(|_| has_inner && has_outer) else {
            return Ok(Overlap::default());
        };
        let begun = begin(groups, true);
        let mut departure = None;
        if let Group::Population(population) = &groups[group] {
            let process = &model.processes()[number];
            let migration = Migration { geometry: model.geometry(), process, number };
            departure = crossing::depart(migration, population, layout, edges, begun.movers())?;
        }
        Ok(Overlap { begun: Some(begun), departure })
    }
}

/// The earlier one of two faults.
fn first(one: Option<FirstFault>, other: Option<FirstFault>) -> Option<FirstFault> {
    one.into_iter().chain(other).min_by_key(|fault| (fault.pass, fault.process, fault.cell))
}

impl From<FirstFault> for Stopped {
    fn from(FirstFault { process, cell, fault, .. }: FirstFault) -> Self {
        Self::new(process, Phase::Rows, cell, fault)
    }
}

/// What a stage has done while messages travel.
#[derive(Default)]
struct Overlap {
    begun: Option<Begun>,
    departure: Option<Departure>,
}
