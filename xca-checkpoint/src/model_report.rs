//! The shape of a model, by which a run recognizes its model.

use crate::components::type_text;
use serde::Serialize;
use xca_core::model::GroupKind;
use xca_core::{Boundary, Faces, Model};

/// The shape of a model.
#[derive(Debug, Clone, Serialize)]
pub struct ModelReport {
    name: String,
    cells: [usize; 3],
    cell_side: f64,
    boundaries: Faces<Boundary>,
    neighbourhood: String,
    groups: Vec<GroupReport>,
    processes: Vec<&'static str>,
}

/// The substates of one struct.
#[derive(Debug, Clone, Serialize)]
struct GroupReport {
    name: &'static str,
    substates: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    slots: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    items_may_leave: Option<bool>,
}

impl ModelReport {
    /// The report of a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let geometry = model.geometry();
        let groups = model.groups().iter().map(|group| {
            let (slots, items_may_leave) = match group.kind() {
                GroupKind::Population { slots, may_leave } => (Some(*slots), Some(*may_leave)),
                GroupKind::Cells { .. } => (None, None),
            };
            let fields = group.schema().fields.iter();
            let substates =
                fields.map(|field| format!("{}: {}", field.name, type_text(field.value_type))).collect();
            GroupReport { name: group.schema().name, substates, slots, items_may_leave }
        });
        Self {
            name: model.name().to_owned(),
            cells: geometry.extents(),
            cell_side: geometry.side(),
            boundaries: geometry.boundaries(),
            neighbourhood: geometry.neighbourhood().to_string(),
            groups: groups.collect(),
            processes: model.processes().iter().map(|process| process.name).collect(),
        }
    }
}
