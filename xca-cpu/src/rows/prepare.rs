//! Preparation of a pass: halos, second buffers and addresses.

use super::ground::{Ground, StageOfStep};
use super::prepared::{Prepared, prepare};
use super::search::{self, Measured, Searches};
use crate::group::Group;
use crate::layout::Layout;
use xca_core::Model;
use xca_core::engine::{StepContext, SubstateId};

/// A pass that is ready to run.
pub(super) struct Ready<'a> {
    pub(super) processes: Vec<Prepared<'a>>,
    pub(super) context: StepContext<'a>,
    /// The substates that it writes, and for each whether it uses the second buffer.
    pub(super) written: Vec<(SubstateId, bool)>,
    pub(super) searches: Searches,
    pub(super) measured: Vec<Measured>,
    /// Whether rows are also continued beyond the faces along y and z, where the following passes read them.
    pub(super) continues_lines: bool,
}

impl<'a> Ready<'a> {
    /// Prepares a pass, and leaves the groups in their state after it. `searches` are those of the rows that
    /// the pass has done already, if there are any.
    pub(super) fn new(
        ground: Ground<'a>,
        groups: &mut [Group],
        stage: StageOfStep<'a>,
        searches: Option<Searches>,
    ) -> Self {
        let Ground { model, layout, precision } = ground;
        refresh(model, layout, groups, stage.processes);
        let searches = match searches {
            Some(searches) => searches.with_ghosts(model, layout, precision, groups),
            None => search::prepare(model, layout, precision, groups, stage.processes),
        };
        let ready = Self::prepare(ground, groups, stage, searches);
        ready.settle(groups, false);
        ready
    }

    /// Prepares a pass over some rows of a part of the space, before the others. The halos must be up to date
    /// where these rows see them. The groups stay in their state before the pass.
    pub(super) fn of_first_rows(ground: Ground<'a>, groups: &mut [Group], stage: StageOfStep<'a>) -> Self {
        let Ground { model, layout, precision } = ground;
        let searches = search::prepare(model, layout, precision, groups, stage.processes);
        Self::prepare(ground, groups, stage, searches)
    }

    /// Prepares a pass that others follow in its wake. They are prepared later, and read the second buffers
    /// that this one writes.
    pub(super) fn in_wake(ground: Ground<'a>, groups: &mut [Group], stage: StageOfStep<'a>) -> Self {
        let Ground { model, layout, precision } = ground;
        refresh(model, layout, groups, stage.processes);
        let searches = search::prepare(model, layout, precision, groups, stage.processes);
        let ready = Self::prepare(ground, groups, stage, searches);
        ready.settle(groups, true);
        Self { continues_lines: layout.halo_repeats()[1], ..ready }
    }

    fn prepare(
        Ground { model, layout, precision }: Ground<'a>,
        groups: &mut [Group],
        stage: StageOfStep<'a>,
        searches: Searches,
    ) -> Self {
        let written = prepare_buffers(model, groups, stage.processes);
        let processes = stage.processes.iter().enumerate();
        let processes = processes
            .map(|(number, &index)| prepare(model, layout, groups, (number, index), precision, &written))
            .collect();
        let measured = Measured::all(model, groups, stage.processes, &written);
        Self { processes, context: stage.context, written, searches, measured, continues_lines: false }
    }

    /// Leaves the groups in their state after the pass.
    fn settle(&self, groups: &mut [Group], in_wake: bool) {
        for &(substate, second) in &self.written {
            match &mut groups[substate.group] {
                Group::Cells(planes) => planes[substate.field].written(second, in_wake),
                Group::Population(population) if second => {
                    std::mem::swap(
                        &mut population.items.fields[substate.field],
                        &mut population.next[substate.field],
                    );
                }
                Group::Population(_) => {}
            }
        }
    }
}

/// Fills the halos that processes read.
fn refresh(model: &Model, layout: &Layout, groups: &mut [Group], processes: &[usize]) {
    let uses = processes.iter().flat_map(|&number| &model.plan().process(number).uses);
    for found in uses.filter(|found| found.elsewhere) {
        if let Group::Cells(planes) = &mut groups[found.substate.group] {
            planes[found.substate.field].refresh(layout);
        }
    }
}

/// Makes second buffers. Returns the substates that the pass writes, and for each whether it uses the second
/// buffer.
fn prepare_buffers(model: &Model, groups: &mut [Group], processes: &[usize]) -> Vec<(SubstateId, bool)> {
    let mut written: Vec<(SubstateId, bool)> = Vec::new();
    for found in processes.iter().flat_map(|&number| &model.plan().process(number).uses) {
        let substate = found.substate;
        if let Group::Population(population) = &mut groups[substate.group]
            && found.is_doubled()
        {
            let bytes = population.items.fields[substate.field].len();
            population.next[substate.field].resize(bytes);
        }
        if found.written {
            match written.iter_mut().find(|(known, _)| *known == substate) {
                Some((_, second)) => *second |= found.elsewhere,
                None => written.push((substate, found.elsewhere)),
            }
        }
    }
    written
}
