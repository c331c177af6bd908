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
    /// Prepares a pass, and leaves the groups in their state after it. Passes prepared later read the second
    /// buffers that this one writes. `in_wake` is set if there are such passes.
    pub(super) fn new(
        Ground { model, layout, precision }: Ground<'a>,
        groups: &mut [Group],
        stage: StageOfStep<'a>,
        in_wake: bool,
    ) -> Self {
        let written = prepare_buffers(model, layout, groups, stage.processes);
        let searches = search::prepare(model, layout, precision, groups, stage.processes);
        let processes = stage.processes.iter().enumerate();
        let processes = processes
            .map(|(number, &index)| prepare(model, layout, groups, (number, index), precision, &written))
            .collect();
        let measured = Measured::all(model, groups, stage.processes, &written);
        for &(substate, second) in &written {
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
        Self {
            processes,
            context: stage.context,
            written,
            searches,
            measured,
            continues_lines: in_wake && layout.halo_follows()[1],
        }
    }
}

/// Fills the halos that will be read, and makes second buffers. Returns the substates that the pass writes,
/// and for each whether it uses the second buffer.
fn prepare_buffers(
    model: &Model,
    layout: &Layout,
    groups: &mut [Group],
    processes: &[usize],
) -> Vec<(SubstateId, bool)> {
    let mut written: Vec<(SubstateId, bool)> = Vec::new();
    for found in processes.iter().flat_map(|&number| &model.plan().process(number).uses) {
        let substate = found.substate;
        match &mut groups[substate.group] {
            Group::Cells(planes) if found.elsewhere => planes[substate.field].refresh(layout),
            Group::Cells(_) => {}
            Group::Population(population) if found.is_doubled() => {
                let bytes = population.items.fields[substate.field].len();
                population.next[substate.field].resize(bytes);
            }
            Group::Population(_) => {}
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
