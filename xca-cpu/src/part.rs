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
            let stopped = (0..now).find_map(|step| {
                let context = StepContext { step: first.step + step, ..first };
                Some((step, self.run_step_of_part(processes.clone(), &context).err()?))
            });
            if let Some(edges) = &mut self.edges {
                let agreed = agree(&mut *edges.border, stopped);
                agreed.map_err(|stopped| Interruption { done: done + stopped.done, ..stopped })?;
            }
            done += now;
        }
        Ok(())
    }

    /// Runs those of these processes that are due in the step.
    fn run_step_of_part(
        &mut self,
        processes: Range<usize>,
        context: &StepContext<'_>,
    ) -> Result<(), Stopped> {
        let start = Instant::now();
        let stages = self.due_stages(processes, context);
        let leaves_out = self.leaves_out();
        let result = stages.iter().try_for_each(|stage| self.run_stage_of_part(stage, leaves_out, context));
        self.end_steps(1, start.elapsed(), false);
        result
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
