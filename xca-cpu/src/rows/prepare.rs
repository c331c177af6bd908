//! What a pass needs before its rows: halos, second buffers, and the cells that searches leave out.

use super::{Group, Prepared};
use crate::layout::Layout;
use crate::slack::{largest, slack as slack_of};
use xca_core::engine::SubstateId;
use xca_core::kernel::CellFilter;
use xca_core::{Model, Precision, Process, ProcessKind};

/// Which cells searches can leave out, where a process of the pass searches.
pub(super) fn filter(
    model: &Model,
    layout: &Layout,
    precision: Precision,
    groups: &[Group],
    prepared: &[Prepared<'_>],
) -> Option<CellFilter> {
    let position = |process: &Process| {
        let field = process.subject().schema.position?;
        let reads = process
            .access
            .iter()
            .any(|access| access.argument == 0 && access.others && access.field == field);
        reads.then_some(field)
    };
    let mut slack: f64 = 0.0;
    let mut searched = false;
    for prepared in prepared.iter().filter(|prepared| prepared.process.kind == ProcessKind::Items) {
        if let (Some(field), Some(number)) = (position(prepared.process), prepared.population)
            && let Group::Population(population) = &groups[number]
        {
            slack = largest(slack, slack_of(population, field, layout, model.geometry()));
            searched = true;
        }
    }
    if searched { CellFilter::new(model.geometry(), precision, layout.steps(), slack) } else { None }
}

/// Fills halos that will be read and makes second buffers; gives the substates that the pass writes, and whether to a second buffer.
pub(super) fn prepare_buffers(
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
                population.next.fields[substate.field].resize(bytes);
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
    // A plane that is written no longer has the halo of its cells.
    for (substate, _) in &written {
        if let Group::Cells(planes) = &mut groups[substate.group] {
            planes[substate.field].touch();
        }
    }
    written
}
