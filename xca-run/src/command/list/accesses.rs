//! What a process works on, in words.

use xca_core::{Model, Process, ProcessKind};

pub(super) fn subject(process: &Process) -> &'static str {
    match process.kind {
        ProcessKind::Cells => "cell",
        ProcessKind::Items => "item",
        ProcessKind::Migration => "item, to move it",
    }
}

/// The substates that a process reads of its own cell or item, those that it reads elsewhere, and those that
/// it writes.
///
/// Where it takes several structs, the names of these stand before those of the substates.
pub(super) fn accesses(model: &Model, number: usize) -> [Vec<String>; 3] {
    let process = &model.processes()[number];
    let mut names = [Vec::new(), Vec::new(), Vec::new()];
    for (access, substate) in process.access.iter().zip(&model.plan().process(number).accesses) {
        let schema = model.groups()[substate.group].schema();
        let field = schema.fields[substate.field].name;
        let name = match process.substates {
            [_] => field.to_owned(),
            _ => format!("{}.{field}", schema.name),
        };
        for (list, uses) in names.iter_mut().zip([access.centre, access.others, access.write]) {
            if uses && !list.contains(&name) {
                list.push(name.clone());
            }
        }
    }
    names
}
