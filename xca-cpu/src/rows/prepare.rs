//! What a pass needs before its rows: halos and second buffers.

use crate::group::Group;
use crate::layout::Layout;
use xca_core::Model;
use xca_core::engine::SubstateId;

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
    // A plane that is written no longer has the halo of its cells.
    for (substate, _) in &written {
        if let Group::Cells(planes) = &mut groups[substate.group] {
            planes[substate.field].touch();
        }
    }
    written
}
