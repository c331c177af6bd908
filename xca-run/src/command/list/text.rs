//! A model as tables of at most 80 columns, where its names allow it.

use super::accesses::{accesses, subject};
use crate::engines::{EngineKind, Engines};
use xca_checkpoint::components::state_names;
use xca_core::model::GroupKind;
use xca_core::{Field, Model, ScalarType};
use xca_io::numbers::counted;
use xca_record::format::Formats;
use xca_report::table::{table, table_with_notes};

/// Everything about a model, and the engines.
pub(super) fn as_text(model: &Model, engines: &Engines, formats: &Formats) -> String {
    let rows = engines.kinds().map(|kind| [kind.name(), kind.about()]);
    let mut parts = vec![space(model), table(["engine", ""], rows, &[])];
    parts.extend(engines.kinds().filter_map(EngineKind::devices).map(|devices| devices.text));
    let chosen = formats.names();
    let rows = formats.all().map(|format| {
        let mark = if chosen.contains(&format.name()) { "yes" } else { "" };
        [format.name(), mark, format.about()]
    });
    parts.push(table(["format", "written", ""], rows, &[]));
    parts.push(substates(model));
    if model.parameters().count() > 0 {
        parts.push(parameters(model));
    }
    parts.push(processes(model));
    parts.join("\n\n")
}

fn space(model: &Model) -> String {
    let geometry = model.geometry();
    let [x, y, z] = geometry.extents();
    format!(
        "{}: {x} x {y} x {z} cells of side {}\n  boundaries: {}\n  neighbourhood: {}",
        model.name(),
        geometry.side(),
        geometry.boundaries(),
        geometry.neighbourhood()
    )
}

fn substates(model: &Model) -> String {
    let rows = model.groups().iter().flat_map(|group| {
        let of = match group.kind() {
            GroupKind::Cells { .. } => "cells".to_owned(),
            GroupKind::Population { slots, .. } => format!("items, {}", counted(*slots as u64, "slot")),
        };
        let name = group.schema().name;
        group.schema().fields.iter().map(move |field| {
            let name = format!("{name}.{}", field.name);
            ([name, field.value_type.to_string(), unit(field), of.clone()], notes(field))
        })
    });
    table_with_notes(["substate", "type", "unit", "of"], rows)
}

fn parameters(model: &Model) -> String {
    let parameters = model.parameters();
    let named = parameters.names().into_iter().zip(parameters.fields()).zip(parameters.values());
    let rows = named.map(|((name, field), value)| {
        let row =
            [name, field.value_type.to_string(), value.to_string(), unit(field), field.range.notation()];
        (row, notes(field))
    });
    table_with_notes(["parameter", "type", "value", "unit", "range"], rows)
}

fn processes(model: &Model) -> String {
    let rows = model.processes().iter().enumerate().map(|(number, process)| {
        let steps = match process.every {
            1 => "each".to_owned(),
            every => format!("every {every}"),
        };
        let uses = ["reads", "reads elsewhere", "writes"].into_iter().zip(accesses(model, number));
        let used = uses.filter(|(_, names)| !names.is_empty());
        let notes = used.map(|(what, names)| format!("{what} {}", names.join(", "))).collect();
        ([process.name.to_owned(), subject(process).to_owned(), steps], notes)
    });
    table_with_notes(["process", "for each", "step"], rows)
}

fn unit(field: &Field) -> String {
    field.unit.unwrap_or_default().to_owned()
}

/// What has no place in a row.
fn notes(field: &Field) -> Vec<String> {
    let states = match field.value_type.scalar {
        scalar @ ScalarType::State(_) => format!("states: {}", state_names(scalar).join(", ")),
        _ => String::new(),
    };
    let computed = if field.computed { "computed from other parameters" } else { "" };
    // Links are for rustdoc.
    let documentation = field.documentation.replace("[`", "`").replace("`]", "`");
    let notes = [&documentation, computed, &states];
    notes.into_iter().filter(|note| !note.is_empty()).map(str::to_owned).collect()
}
