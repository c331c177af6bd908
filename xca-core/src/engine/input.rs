//! Checks of the input of engines.
//!
//! Kernels trust the lengths and ranges that engines keep, and the methods of an engine are public. Each
//! engine therefore calls these functions first. Unsafe code relies on their checks.

use super::{Fault, InputError, Part, Plane, Population, SubstateId};
use crate::model::{Group, GroupKind, Model};
use xca_values::Field;
use xca_values::{Precision, ScalarType};

/// Checks that the model has a substate.
///
/// # Errors
/// Returns an error otherwise.
pub fn check_substate(model: &Model, substate: SubstateId) -> Result<(), InputError> {
    checked_group(model, substate).map(|_| ())
}

/// Checks that the model has a plane.
///
/// # Errors
/// Returns an error otherwise.
pub fn check_plane(model: &Model, plane: Plane) -> Result<(), InputError> {
    let group = match plane {
        Plane::Values(substate) => return check_substate(model, substate),
        Plane::Counts(group) | Plane::Labels(group) => group,
    };
    let groups = model.groups().len();
    let definition = model.groups().get(group).ok_or(InputError::NoSuchGroup { group, groups })?;
    match definition.kind() {
        GroupKind::Population { .. } => Ok(()),
        GroupKind::Cells { .. } => Err(InputError::NotAPopulation(definition.schema().name)),
    }
}

/// Checks new values for a whole substate. `items` is the number of items, if the group is a population.
///
/// # Errors
/// Returns an error if the model does not have the substate, or the number of bytes is wrong.
pub fn check_values(
    model: &Model,
    precision: Precision,
    substate: SubstateId,
    items: usize,
    values: &[u8],
) -> Result<(), InputError> {
    let group = checked_group(model, substate)?;
    let count = match group.kind() {
        GroupKind::Cells { .. } => model.geometry().cells(),
        GroupKind::Population { .. } => items,
    };
    check_bytes(group, precision, substate.field, count, values)
}

/// Checks new values for a substate of cells in a part of the space.
///
/// # Errors
/// Returns an error if the model does not have the substate, it is not of cells, or the number of bytes is
/// wrong.
pub fn check_values_of_part(
    model: &Model,
    precision: Precision,
    substate: SubstateId,
    part: &Part,
    values: &[u8],
) -> Result<(), InputError> {
    check_cells(model, substate, &[])?;
    let count = part.cells(model.geometry());
    check_bytes(&model.groups()[substate.group], precision, substate.field, count, values)
}

/// Checks new values for a substate of cells in so many rows.
///
/// # Errors
/// As [`check_values_of_part`].
pub fn check_values_of_rows(
    model: &Model,
    precision: Precision,
    substate: SubstateId,
    rows: usize,
    values: &[u8],
) -> Result<(), InputError> {
    check_cells(model, substate, &[])?;
    let count = rows * model.geometry().extents()[0];
    check_bytes(&model.groups()[substate.group], precision, substate.field, count, values)
}

/// Checks that cells belong to a part of the space.
///
/// # Errors
/// Returns an error if one does not.
pub fn check_cells_of_part(model: &Model, part: &Part, cells: &[usize]) -> Result<(), InputError> {
    let other = cells.iter().find(|cell| !part.holds(model.geometry(), **cell));
    let Part { y, z } = part.clone();
    other.map_or(Ok(()), |cell| Err(InputError::NotInPart { cell: *cell, y, z }))
}

/// Checks the linear indices of cells whose values of a substate will be read.
///
/// # Errors
/// Returns an error if the model does not have the substate, it is not of cells, or the space does not have
/// one of the cells.
pub fn check_cells(model: &Model, substate: SubstateId, cells: &[usize]) -> Result<(), InputError> {
    let group = checked_group(model, substate)?;
    if let GroupKind::Population { .. } = group.kind() {
        return Err(InputError::NotOfCells(group.schema().name));
    }
    let count = model.geometry().cells();
    let unknown = cells.iter().find(|cell| **cell >= count);
    unknown.map_or(Ok(()), |cell| Err(InputError::NoSuchCell { cell: *cell, cells: count }))
}

/// Checks the linear indices of cells and their new values of a substate.
///
/// # Errors
/// As [`check_cells`], or if the number of bytes is wrong.
pub fn check_values_of_cells(
    model: &Model,
    precision: Precision,
    substate: SubstateId,
    cells: &[usize],
    values: &[u8],
) -> Result<(), InputError> {
    check_cells(model, substate, cells)?;
    check_bytes(&model.groups()[substate.group], precision, substate.field, cells.len(), values)
}

/// Checks new items for a population.
///
/// # Errors
/// Returns [`Fault::CellFull`] if a cell has more items than slots. Returns an [`InputError`] if the group is
/// not a population, or its counts, labels and fields do not agree.
pub fn check_population(
    model: &Model,
    precision: Precision,
    group: usize,
    population: &Population,
) -> Result<(), Fault> {
    check_population_of_part(model, precision, group, &Part::whole(model.geometry()), population)
}

/// Checks new items for a population in a part of the space.
///
/// # Errors
/// As [`check_population`].
pub fn check_population_of_part(
    model: &Model,
    precision: Precision,
    group: usize,
    part: &Part,
    population: &Population,
) -> Result<(), Fault> {
    let groups = model.groups().len();
    let definition = model.groups().get(group).ok_or(InputError::NoSuchGroup { group, groups })?;
    let substates = definition.schema().name;
    let GroupKind::Population { slots, .. } = *definition.kind() else {
        return Err(InputError::NotAPopulation(substates).into());
    };
    let cells = population.counts.len().min(part.cells(model.geometry()));
    let place = |cell| part.indices(model.geometry(), cell);
    if let Some(fault) = full_cell(&population.counts[..cells], slots, place) {
        return Err(fault);
    }
    let reason = wrong_items(population, definition, precision, slots, (model, part));
    reason.map_or(Ok(()), |reason| Err(InputError::Items { substates, reason }.into()))
}

/// The fault of the first cell with more items than slots. `place` gives the indices of a cell.
pub(crate) fn full_cell(counts: &[u32], slots: usize, place: impl Fn(usize) -> [usize; 3]) -> Option<Fault> {
    let mut counts = counts.iter().map(|items| *items as usize).enumerate();
    let (cell, items) = counts.find(|(_, items)| *items > slots)?;
    Some(Fault::CellFull { process: None, cell: place(cell), items, slots })
}

fn checked_group(model: &Model, SubstateId { group, field }: SubstateId) -> Result<&Group, InputError> {
    let groups = model.groups().len();
    let definition = model.groups().get(group).ok_or(InputError::NoSuchGroup { group, groups })?;
    let (substates, fields) = (definition.schema().name, definition.schema().fields.len());
    if field < fields { Ok(definition) } else { Err(InputError::NoSuchField { substates, field, fields }) }
}

fn check_bytes(
    group: &Group,
    precision: Precision,
    field: usize,
    count: usize,
    values: &[u8],
) -> Result<(), InputError> {
    let definition = &group.schema().fields[field];
    let (wanted, given) = (definition.value_type.stored(precision).size() * count, values.len());
    let (substates, substate) = (group.schema().name, definition.name);
    if given != wanted {
        return Err(InputError::WrongLength { substates, substate, wanted, given });
    }
    let reason = wrong_state(values, definition);
    reason.map_or(Ok(()), |reason| Err(InputError::NoState { substates, reason }))
}

/// What is wrong with the values of a field that has only some: bool and states.
fn wrong_state(values: &[u8], field: &Field) -> Option<String> {
    let largest = match field.value_type.scalar {
        ScalarType::Bool => 1,
        ScalarType::State(names) => names.largest(),
        _ => return None,
    };
    let wrong = values.iter().find(|value| **value > largest)?;
    Some(format!("`{}` is {}, which {wrong} is not", field.name, field.value_type.described()))
}

/// What is wrong with the fields of a group that has so many cells or items.
pub(crate) fn wrong_fields(
    fields: &[Vec<u8>],
    group: &Group,
    precision: Precision,
    count: usize,
) -> Option<String> {
    let wanted = group.schema().fields;
    if fields.len() != wanted.len() {
        return Some(format!("it has {} substates, not {}", fields.len(), wanted.len()));
    }
    let sizes = group.stored(precision).into_iter().map(|stored| stored.size() * count);
    let mut wrong = fields.iter().zip(sizes).zip(wanted).filter(|((bytes, size), _)| bytes.len() != *size);
    let wrong_size = wrong.next().map(|((bytes, size), field)| {
        format!("`{}` takes {} bytes, not the {size} of a run in {precision}", field.name, bytes.len())
    });
    wrong_size.or_else(|| fields.iter().zip(wanted).find_map(|(bytes, field)| wrong_state(bytes, field)))
}

/// What is wrong with the fields, cells and labels of items.
pub(crate) fn wrong_items(
    population: &Population,
    group: &Group,
    precision: Precision,
    slots: usize,
    (model, part): (&Model, &Part),
) -> Option<String> {
    if let Some(reason) = wrong_fields(&population.fields, group, precision, population.labels.len()) {
        return Some(reason);
    }
    let cells = part.cells(model.geometry());
    if population.counts.len() != cells {
        return Some(format!("it has {} cells, not {cells}", population.counts.len()));
    }
    let items: u64 = population.counts.iter().map(|count| u64::from(*count)).sum();
    if items != population.labels.len() as u64 {
        return Some(format!("it has {} items, but {items} in its cells", population.labels.len()));
    }
    let mut first = 0;
    for (cell, count) in population.counts.iter().enumerate() {
        let labels = &population.labels[first..first + *count as usize];
        first += labels.len();
        let place = || format!("cell {:?}", part.indices(model.geometry(), cell));
        if labels.len() > slots {
            return Some(format!("{} has {} items in {slots} slots", place(), labels.len()));
        }
        if !labels.is_sorted() {
            return Some(format!("the items of {} are not in the order of their labels", place()));
        }
    }
    let mut labels = population.labels.clone();
    labels.sort_unstable();
    let twice = labels.windows(2).find(|pair| pair[0] == pair[1]);
    twice.map(|pair| format!("the label {} stands on two items", pair[0]))
}
