//! What a state shows, as numbers: for a screen, which has other pixels than a picture.

use super::cells::sides_in_cells;
use super::look::{Look, LookError};
use super::painting::Field;
use super::panel::Panel;
use super::seen::{Seen, wider};
use super::source::Source;
use super::{Recorder, Shown};
use crate::view::{AnyView, Quantity};
use xca_checkpoint::components::{Part, name_of};
use xca_core::{EngineFailure, Simulation};
use xca_picture::{Category, ColourMap, Scalar};

/// What is seen of one state.
#[derive(Debug, Clone, PartialEq)]
pub struct Sight {
    pub subject: Subject,
    /// One for each cell of the layer, or for each item.
    pub values: Vec<f64>,
    /// The cells that are not drawn.
    pub hidden: Option<Vec<bool>>,
    /// The name of the substate that they are of, and what a scale calls it.
    pub substate: String,
    pub label: String,
    pub map: ColourMap,
    /// If not empty, the values are no magnitudes but these kinds or states.
    pub kinds: Vec<Category>,
    /// The ends of the scale; of states so far unless they are fixed. None where no value is finite.
    pub range: Option<[f64; 2]>,
}

/// What has the values.
#[derive(Debug, Clone, PartialEq)]
pub enum Subject {
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
    /// The view of a look; an axis is allowed for items, too, which have no layers but are looked at along
    /// it.
    pub fn sighting(&self, look: &Look) -> Result<Panel, LookError> {
        match self.panel(look) {
            Err(LookError::NotLayered) if look.layer.is_none() => {
                self.panel(&Look { axis: None, ..look.clone() })
            }
            other => other,
        }
    }

    /// The names of the substates that can be looked at, in the order of the views.
    pub fn substates(&self) -> Vec<&'static str> {
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

impl Panel {
    /// What a state shows on the scale of the states before, which is widened where it goes beyond.
    pub fn sight(
        &self,
        simulation: &Simulation,
        earlier: Option<[f64; 2]>,
    ) -> Result<Option<Sight>, EngineFailure> {
        let (model, precision) = (simulation.model(), simulation.options().precision);
        let (group, geometry) = (&model.groups()[self.shown.group], model.geometry());
        let schema = group.schema();
        // What is computed has no other name than its label.
        let name = |quantity: &Quantity, label: &str| match quantity.part() {
            Some(Part { field, component }) => {
                schema.fields.get(field).map_or_else(String::new, |field| name_of(field, component))
            }
            None => label.to_owned(),
        };
        let seen = self.shown.seen(model, precision, Source::Simulation(simulation))?;
        let present = seen.range();
        let range = earlier.map_or(present, |earlier| Some(wider(earlier, present)));
        Ok(match (&self.shown.view, seen) {
            (AnyView::Cells(view), Seen::Cells { is_float, values, hidden, .. }) => {
                let label = view.label(schema);
                let field = Field {
                    view,
                    schema,
                    geometry,
                    label: &label,
                    is_float,
                    values: &values,
                    heights: None,
                    hidden: hidden.as_deref(),
                    corner: None,
                    scale: self.shown.scale(geometry),
                };
                let Scalar { map, range, .. } = field.scalar(range, None);
                let kinds = field.kinds(earlier);
                let ([across, down], layers) = field.plane();
                let (axis, layer) = (view.axis, view.drawn_layer(geometry));
                let subject = Subject::Layer { cells: [across, down], axis, layer, layers };
                let substate = name(&view.quantity(), &label);
                Some(Sight { subject, values, hidden, substate, label, map, kinds, range })
            }
            (AnyView::Items(view), Seen::Items { positions, values }) => {
                let side = geometry.side();
                let colour = view.colour(schema);
                // Without a colour all are alike.
                let values = if colour.is_some() { values } else { vec![0.0; positions.len()] };
                let subject = Subject::Items {
                    positions: positions.into_iter().map(|position| position.map(|x| x / side)).collect(),
                    radius: view.radius.unwrap_or(side / 4.0) / side,
                    extents: sides_in_cells(geometry).map(|cells| cells.ceil() as usize),
                };
                let (substate, label) = colour
                    .map(|drawn| (name(&drawn.quantity, &drawn.label), drawn.label))
                    .unwrap_or_default();
                let (map, range) = (ColourMap::default(), self.range.or(range));
                let kinds = view.categories(schema);
                Some(Sight { subject, values, hidden: None, substate, label, map, kinds, range })
            }
            _ => None,
        })
    }
}
