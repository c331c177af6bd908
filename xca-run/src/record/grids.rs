//! The final state of a layer of cells as ESRI ASCII grids, one for each substate.

use super::values::Plane;
use super::{RecordError, Recorder};
use crate::output::ascii_grid::AsciiGrid;
use std::path::PathBuf;
use xca_core::engine::SubstateId;
use xca_core::model::GroupKind;
use xca_core::{GroupSnapshot, Model, Precision, Snapshot, StoredScalar};

/// One lane of a substate of cells, and the file that it is written to.
struct Lane {
    file: String,
    substate: SubstateId,
    lane: usize,
}

const LANES: [&str; 4] = ["_x", "_y", "_z", "_w"];

/// What the final grids of a model are; none of one with several layers.
fn lanes(model: &Model) -> Vec<Lane> {
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
            let lanes = usize::from(field.value_type.lanes);
            for (lane, letter) in LANES.into_iter().take(lanes).enumerate() {
                let letter = if lanes > 1 { letter } else { "" };
                let file = format!("final_{of}{}{letter}.asc", field.name);
                all.push(Lane { file, substate: SubstateId { group, field: index }, lane });
            }
        }
    }
    all
}

impl Recorder {
    /// The files of the final grids, if they are wanted.
    pub(super) fn grid_files(&self) -> Vec<String> {
        let wanted = self.set_up.grids.then(|| lanes(self.model()));
        wanted.into_iter().flatten().map(|lane| lane.file).collect()
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
        for Lane { file, substate, lane } in lanes(model) {
            let GroupSnapshot::Cells(fields) = &snapshot.groups[substate.group] else { continue };
            let stored = model.stored(substate, precision);
            let mut values = Plane::all(stored, &fields[substate.field]).lane(lane);
            if stored.scalar == StoredScalar::F32 {
                values.iter_mut().for_each(|value| *value = with_digits_of_f32(*value));
            }
            let grid = AsciiGrid::new([columns, rows], model.geometry().side(), values);
            if let Some(grid) = grid.map(|grid| grid.with_corner(self.set_up.corner.unwrap_or_default())) {
                grid.write(&path(&file))?;
            }
        }
        Ok(())
    }
}

/// The `f64` that has the digits of an `f32`: 0.1 of 0.1f32, which is 0.10000000149011612.
fn with_digits_of_f32(value: f64) -> f64 {
    format!("{:e}", value as f32).parse().unwrap_or(value)
}
