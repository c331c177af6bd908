//! What a model takes on a device.

use crate::device::Device;
use crate::error::NotOnDevice;
use crate::groups::{Group, Groups};
use crate::plane::{Plane, size_on_device};
use crate::population::Population;
use crate::program::{Manner, Program};
use crate::space::{Section, Space};
use std::collections::HashSet;
use xca_core::engine::{Part, SubstateId};
use xca_core::model::GroupKind;
use xca_core::{Model, ProcessKind, StoredScalar};
use xca_wgsl::{Content, Dispatch};

/// The bytes that a model takes at least: every substate of cells once.
pub(crate) fn least_memory(model: &Model, precision: xca_core::Precision) -> u128 {
    let size = |group: &xca_core::model::Group| match group.kind() {
        GroupKind::Cells { .. } => group.stored(precision).into_iter().map(size_on_device).sum(),
        GroupKind::Population { .. } => 2 * size_of::<u32>(),
    };
    let bytes: usize = model.groups().iter().map(size).sum();
    model.geometry().cells() as u128 * bytes as u128
}

/// Whether the device knows all types of the model.
pub(super) fn check_types(model: &Model, manner: Manner, device: &Device) -> Result<(), NotOnDevice> {
    if device.adapter().has_f64 {
        return Ok(());
    }
    if manner.precision == xca_core::Precision::F64 {
        return Err(NotOnDevice::NoF64 { what: "this precision".to_owned() });
    }
    for group in model.groups() {
        for (field, stored) in group.schema().fields.iter().zip(group.stored(manner.precision)) {
            if stored.scalar == StoredScalar::F64 {
                return Err(NotOnDevice::NoF64 { what: format!("the substate `{}`", field.name) });
            }
        }
    }
    Ok(())
}

/// The space, or a part of it, cut so that the largest substate of cells can be reached.
pub(super) fn space_of(model: &Model, part: Option<Part>, manner: Manner) -> Result<Space, NotOnDevice> {
    let of_cells = model.groups().iter().filter(|group| matches!(group.kind(), GroupKind::Cells { .. }));
    let sizes = of_cells.flat_map(|group| group.stored(manner.precision)).map(size_on_device);
    let largest = sizes.max().unwrap_or(4);
    let most = manner.reach;
    let part = part.unwrap_or_else(|| Part::whole(model.geometry()));
    Space::new(model.geometry(), &part, most / largest as u64).map_err(|too_large| NotOnDevice::TooLarge {
        what: "a substate with its neighbours".to_owned(),
        wanted: too_large.wanted * largest as u128,
        most,
    })
}

/// Memory for all substates.
pub(super) fn groups_of(
    model: &Model,
    manner: Manner,
    device: &Device,
    (space, programs, doubled): (&Space, &[Program], &HashSet<SubstateId>),
) -> Result<Groups, NotOnDevice> {
    let mut groups = Vec::new();
    for (number, group) in model.groups().iter().enumerate() {
        let types = group.stored(manner.precision);
        let fields = group.schema().fields;
        let doubled = |field| doubled.contains(&SubstateId { group: number, field });
        groups.push(match group.kind() {
            GroupKind::Cells { .. } => {
                let planes = types.iter().enumerate().map(|(field, stored)| {
                    Plane::new(device, fields[field].name, *stored, space.stored(), doubled(field))
                });
                Group::Cells(planes.collect::<Result<_, _>>()?)
            }
            GroupKind::Population { slots, may_leave } => {
                let moves = programs.iter().any(|program| {
                    program.process.kind == ProcessKind::Migration
                        && program.population(model) == Some(number)
                });
                let doubled = (0..types.len()).map(doubled).collect();
                let rules = (*slots, *may_leave);
                let population = Population::new(device, space, fields, types, rules, (doubled, moves))?;
                Group::Population(Box::new(population))
            }
        });
    }
    Ok(Groups::new(device, groups, records(space, programs, |_| 0))?)
}

/// The bytes of the records of faults: one for each workgroup of a process over cells, or over the items that
/// there are.
pub(super) fn records(space: &Space, programs: &[Program], items: impl Fn(&Program) -> usize) -> u64 {
    let of = |program: &Program| {
        let layout = program.shader.bindings.iter().find_map(|binding| match &binding.content {
            Content::Faults(layout) => Some(layout),
            _ => None,
        })?;
        let workgroups = match program.shader.dispatch {
            Dispatch::Cells(size) => {
                let of_section =
                    |section: &Section| section.workgroups(size).into_iter().map(u64::from).product();
                space.sections().iter().map(of_section).max().unwrap_or(1)
            }
            Dispatch::Items(size) => (items(program) as u64).div_ceil(u64::from(size)).max(1),
        };
        Some(workgroups * u64::from(layout.size))
    };
    programs.iter().filter_map(of).max().unwrap_or(0)
}

/// The substates of cells that some process reads at neighbours.
pub(super) fn looked_at(model: &Model) -> HashSet<SubstateId> {
    let uses = (0..model.processes().len()).flat_map(|process| &model.plan().process(process).uses);
    uses.filter(|used| used.elsewhere)
        .map(|used| used.substate)
        .filter(|substate| matches!(model.groups()[substate.group].kind(), GroupKind::Cells { .. }))
        .collect()
}
