//! What a state shows, as numbers: for a screen, which has other pixels than a picture.

use super::cells::{Cells, ends, wider};
use super::drawing::{Drawing, Look, LookError};
use super::items::Items;
use super::{Recorder, Shown};
use crate::output::picture::{ColourMap, Scalar};
use xca_core::{Simulation, Snapshot};

/// What is seen of one state.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sight {
    pub(crate) subject: Subject,
    /// One for each cell of the layer, or for each item.
    pub(crate) values: Vec<f64>,
    /// The name of the substate that they are of, and what a scale calls it.
    pub(crate) substate: String,
    pub(crate) label: String,
    pub(crate) map: ColourMap,
    /// If not empty, the values are no magnitudes but these kinds, each with its name.
    pub(crate) kinds: Vec<(f64, String)>,
    /// The ends of the scale; of states so far unless they are fixed. None where no value is finite.
    pub(crate) range: Option<[f64; 2]>,
}

/// What has the values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Subject {
    /// The cells of a layer, the horizontal axis fastest, the lowest row first.
    Layer {
        /// Cells across and down.
        cells: [usize; 2],
        axis: usize,
        layer: usize,
        layers: usize,
    },
    Items {
        /// In sides of a cell, as is the radius.
        positions: Vec<[f64; 3]>,
        radius: f64,
        /// The cells along each axis.
        extents: [usize; 3],
    },
}

impl Recorder {
    /// As [`Self::drawing`]; an axis is allowed for items, too, which have no layers but are looked at along it.
    pub(crate) fn sighting(&self, look: &Look) -> Result<Drawing<'_>, LookError> {
        match self.drawing(look.clone()) {
            Err(LookError::NotLayered) if look.layer.is_none() => {
                self.drawing(Look { axis: None, ..look.clone() })
            }
            other => other,
        }
    }

    /// The names of the substates that can be looked at, in the order of the views.
    pub(crate) fn substates(&self) -> Vec<&'static str> {
        let mut names = Vec::new();
        for Shown { group, .. } in &self.shown {
            let schema = self.model().groups()[*group].schema();
            for (number, field) in schema.fields.iter().enumerate() {
                // Where items are is seen anyway.
                if schema.position != Some(number) && !names.contains(&field.name) {
                    names.push(field.name);
                }
            }
        }
        names
    }
}

impl Drawing<'_> {
    /// What a state shows on the scale of the states before, which is widened where it goes beyond.
    pub(crate) fn sight(
        &self,
        simulation: &Simulation,
        snapshot: &Snapshot,
        earlier: Option<[f64; 2]>,
    ) -> Option<Sight> {
        let fields = simulation.model().groups()[self.shown.group].schema().fields;
        let name = |field: usize| fields.get(field).map_or("", |field| field.name).to_owned();
        if let Some(cells) = self.shown.cells(simulation, snapshot) {
            return Some(of_cells(&cells, name, earlier));
        }
        let items = self.shown.items(simulation, snapshot)?;
        Some(of_items(&items, name, self.look.range, earlier, simulation))
    }
}

fn of_cells(cells: &Cells<'_>, name: impl Fn(usize) -> String, earlier: Option<[f64; 2]>) -> Sight {
    let (field, label) = cells.drawn();
    let (is_float, values) = cells.layer_values();
    let present = ends(&values);
    let range = earlier.map_or(present, |earlier| Some(wider(earlier, present)));
    let Scalar { map, range, .. } = cells.scalar(&label, is_float, &[], range, None);
    let kinds = cells.kinds(is_float, &values, earlier);
    let kinds = kinds.into_iter().map(|(value, name)| (value, name.to_owned())).collect();
    let (plane, layers) = cells.plane();
    let subject = Subject::Layer { cells: plane, axis: cells.axis(), layer: cells.layer(), layers };
    Sight { subject, values, substate: name(field), label, map, kinds, range }
}

fn of_items(
    items: &Items<'_>,
    name: impl Fn(usize) -> String,
    fixed: Option<[f64; 2]>,
    earlier: Option<[f64; 2]>,
    simulation: &Simulation,
) -> Sight {
    let geometry = simulation.model().geometry();
    let side = geometry.side();
    let colour = items.colour();
    let values = match &colour {
        Some((field, _)) => items.plane(*field).magnitudes(),
        None => vec![0.0; items.len()],
    };
    let positions = items.positions().to_points();
    let subject = Subject::Items {
        positions: positions.into_iter().map(|position| position.map(|x| x / side)).collect(),
        radius: items.radius() / side,
        extents: geometry.extents(),
    };
    let present = items.range();
    let range = fixed.or(earlier.map_or(present, |earlier| Some(wider(earlier, present))));
    let (field, label) = colour.map_or((usize::MAX, String::new()), |colour| colour);
    let map = ColourMap::default();
    Sight { subject, values, substate: name(field), label, map, kinds: Vec::new(), range }
}
