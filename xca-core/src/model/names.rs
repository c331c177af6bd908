//! Names that would mean two things: in tables, frames and messages.

use super::{Group, GroupKind, ModelError};

/// What every item has beside its substates.
const LABEL: &str = "label";

/// Refuses structs, and substates of one struct, that could not be told apart by their names.
pub(super) fn check_names(groups: &[Group]) -> Result<(), ModelError> {
    for (number, group) in groups.iter().enumerate() {
        let name = group.schema.name;
        if let Some(other) = groups[..number].iter().find(|other| other.schema.name == name) {
            let (first, second) = (other.type_name, group.type_name);
            return Err(ModelError::SameStructName { name, first, second });
        }
        check_columns(group)?;
    }
    Ok(())
}

fn check_columns(group: &Group) -> Result<(), ModelError> {
    let schema = group.schema;
    let substates = schema.name;
    let of_items = matches!(group.kind, GroupKind::Population { .. });
    let mut known: Vec<(String, &'static str)> = Vec::new();
    for (number, field) in schema.fields.iter().enumerate() {
        for column in schema.columns(number) {
            if of_items && column == LABEL {
                return Err(ModelError::FieldNamedLabel { substates });
            }
            if let Some((_, first)) = known.iter().find(|(other, _)| *other == column) {
                return Err(ModelError::SameColumn { substates, first, second: field.name, column });
            }
            known.push((column, field.name));
        }
    }
    Ok(())
}
