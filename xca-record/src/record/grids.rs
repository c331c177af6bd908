//! The final state of a layer of cells as ESRI ASCII grids, one for each component of each substate. `bool`
//! and states are numbers.

use super::values::Plane;
use super::{RecordError, Recorder};
use std::path::PathBuf;
use xca_core::engine::SubstateId;
use xca_core::model::GroupKind;
use xca_core::{GroupSnapshot, Model, Precision, Snapshot, StoredScalar};
use xca_io::ascii_grid::AsciiGrid;

/// One component of a substate of cells, and the file that it is written to.
struct Component {
    file: String,
    substate: SubstateId,
    component: usize,
}

/// What the final grids of a model are; none of one with several layers.
fn components(model: &Model) -> Vec<Component> {
    let of_cells = |kind: &GroupKind| matches!(kind, GroupKind::Cells { .. });
    let groups = || model.groups().iter().enumerate().filter(|(_, group)| of_cells(group.kind()));
    let fields = || groups().flat_map(|(_, group)| group.schema().fields);
    let mut all = Vec::new();
    if model.geometry().extents()[2] > 1 {
        return all;
    }
    for (group, of) in groups() {
        for (index, field) in of.schema().fields.iter().enumerate() {
            let is_single = fields().filter(|other| other.name == field.name).count() == 1;
            let of = if is_single { String::new() } else { format!("{}_", of.schema().name.to_lowercase()) };
            for (component, name) in field.value_type.component_names().into_iter().enumerate() {
                let gap = if name.is_empty() { "" } else { "_" };
                let file = format!("final_{of}{}{gap}{name}.asc", field.name);
                all.push(Component { file, substate: SubstateId { group, field: index }, component });
            }
        }
    }
    all
}

impl Recorder {
    /// The files of the final grids, if they are wanted.
    pub(super) fn grid_files(&self) -> Vec<String> {
        let wanted = self.set_up.grids.then(|| components(self.model()));
        wanted.into_iter().flatten().map(|component| component.file).collect()
    }

    /// Writes the grids, if they are wanted.
    pub(super) fn write_grids(
        &self,
        snapshot: &Snapshot,
        precision: Precision,
        path: impl Fn(&str) -> PathBuf,
    ) -> Result<(), RecordError> {
        if !self.set_up.grids {
            return Ok(());
        }
        let model = self.model();
        let [columns, rows, _] = model.geometry().extents();
        for Component { file, substate, component } in components(model) {
            let GroupSnapshot::Cells(fields) = &snapshot.groups[substate.group] else { continue };
            let stored = model.stored(substate, precision);
            let mut values = Plane::all(stored, &fields[substate.field]).component(component);
            if stored.scalar == StoredScalar::F32 {
                values.iter_mut().for_each(|value| *value = with_digits_of_f32(*value));
            }
            mask(&mut values, self.set_up.missing());
            let grid = AsciiGrid::new([columns, rows], model.geometry().side(), values);
            if let Some(grid) = grid.map(|grid| grid.with_corner(self.set_up.placement().corner)) {
                grid.write(&path(&file))?;
            }
        }
        Ok(())
    }
}

/// Takes the values from the cells without ground.
fn mask(values: &mut [f64], missing: Option<&[bool]>) {
    let masked = values.iter_mut().zip(missing.unwrap_or_default());
    masked.filter(|(_, is_missing)| **is_missing).for_each(|(value, _)| *value = f64::NAN);
}

/// The `f64` that has the digits of an `f32`: 0.1 of 0.1f32, which is 0.10000000149011612.
fn with_digits_of_f32(value: f64) -> f64 {
    format!("{:e}", value as f32).parse().unwrap_or(value)
}
