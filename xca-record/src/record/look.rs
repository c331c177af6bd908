//! What is wanted of a drawing, and the view of the model that it comes to.

use super::Recorder;
use super::panel::Panel;
use super::shown::Shown;
use crate::view::{AnyView, Drawn, Quantity};
use xca_checkpoint::components::{DrawnPart, Part};

/// How a state is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ViewKind {
    /// One layer of cells
    Slice,
    /// All cells as cubes; those that are not 0 of a whole number, else with an octant cut out
    Isometric,
    /// The items of a population
    Spheres,
}

/// What is drawn, and how; what is not said is as in the pictures of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Look {
    pub substate: Option<String>,
    pub view: Option<ViewKind>,
    /// The number of the axis that layers are counted along.
    pub axis: Option<usize>,
    pub layer: Option<usize>,
    /// Whether axis and layer are meant for slices alone, and nothing to others.
    pub slices_only: bool,
    /// The ends of the scale.
    pub range: Option<[f64; 2]>,
}

/// A look that does not fit the model.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum LookError {
    #[error("unknown substate `{name}`; there are {known}")]
    NoSubstate { name: String, known: String },
    #[error("`{of}` are substates of {kind}, which cannot be drawn as {view}")]
    View { of: String, kind: &'static str, view: &'static str },
    #[error("this model has no {0} to draw")]
    Nothing(&'static str),
    #[error("--axis and --layer are for slices of cells")]
    NotLayered,
    #[error("there is no layer {layer}: along that axis there are {layers}, from 0")]
    Layer { layer: usize, layers: usize },
    #[error(
        "{width}x{height} pixels are too few for {panels} panels; they take {least_width}x{least_height} or more"
    )]
    Pixels { width: usize, height: usize, panels: usize, least_width: usize, least_height: usize },
}

impl Recorder {
    /// The panel of a look.
    pub(super) fn panel(&self, look: &Look) -> Result<Panel, LookError> {
        let (original, field) = self.chosen(look)?;
        let mut shown = original.with_view(original.view.clone());
        let kind = match &shown.view {
            AnyView::Items(_) => ViewKind::Spheres,
            AnyView::Cells(_) => ViewKind::Slice,
        };
        let wanted = look.view.unwrap_or(kind);
        if (kind == ViewKind::Spheres) != (wanted == ViewKind::Spheres) {
            let (of, view) = (shown.view.name().to_owned(), wanted.words());
            return Err(LookError::View {
                of,
                kind: if shown.is_of_items() { "items" } else { "cells" },
                view,
            });
        }
        let is_layered = look.axis.is_some() || look.layer.is_some();
        if wanted != ViewKind::Slice && is_layered && !look.slices_only {
            return Err(LookError::NotLayered);
        }
        match &mut shown.view {
            AnyView::Items(view) => {
                if let Some(drawn) = field.filter(|drawn| !is_drawn(view.colour.as_ref(), drawn)) {
                    view.colour = Some(drawn);
                }
            }
            AnyView::Cells(view) => {
                view.block = wanted == ViewKind::Isometric;
                if let Some(drawn) = field.filter(|drawn| !is_drawn(view.drawn.as_ref(), drawn)) {
                    // The scale and the kinds are those of another substate.
                    (view.drawn, view.range, view.map) = (Some(drawn), None, None);
                    view.relief = None;
                    view.kinds.clear();
                }
                view.range = look.range.or(view.range);
                if view.block {
                    view.relief = view.relief.filter(|_| self.model().geometry().extents()[2] == 1);
                } else {
                    if let Some(axis) = look.axis {
                        (view.axis, view.layer) = (axis, None);
                        view.relief = view.relief.filter(|_| axis == 2);
                    }
                    view.layer = look.layer.or(view.layer);
                }
                let layers = self.model().geometry().extents()[view.axis];
                if let Some(layer) = view.layer.filter(|layer| *layer >= layers) {
                    return Err(LookError::Layer { layer, layers });
                }
            }
        }
        Ok(Panel { shown, range: look.range })
    }

    /// The view that shows what is wanted, and the substate or component that is named.
    fn chosen(&self, look: &Look) -> Result<(&Shown, Option<Drawn>), LookError> {
        let Some(name) = &look.substate else {
            let of_items = look.view.map(|view| view == ViewKind::Spheres);
            let found =
                self.shown.iter().find(|shown| of_items.is_none_or(|wanted| shown.is_of_items() == wanted));
            let what = if of_items == Some(true) { "items" } else { "cells" };
            return found.map(|shown| (shown, None)).ok_or(LookError::Nothing(what));
        };
        let fields = |shown: &Shown| self.model().groups()[shown.group].schema().fields;
        for shown in &self.shown {
            if let Some(part) = Part::named(fields(shown), name) {
                let field = &fields(shown)[part.field];
                let label = DrawnPart::of(field.value_type, part.component).label(field);
                return Ok((shown, Some(Drawn { quantity: Quantity::Part(part), label })));
            }
        }
        let known = self.shown.iter().flat_map(fields).map(|field| {
            match field.value_type.component_suffixes().as_slice() {
                [first, .., last] => format!("{} ({first} to {last})", field.name),
                _ => field.name.to_owned(),
            }
        });
        let known = known.collect::<Vec<_>>().join(", ");
        Err(LookError::NoSubstate { name: name.clone(), known })
    }
}

/// Whether a view shows this already, and has words for it.
fn is_drawn(shown: Option<&Drawn>, wanted: &Drawn) -> bool {
    shown.is_some_and(|shown| shown.quantity.part().is_some_and(|part| Some(part) == wanted.quantity.part()))
}

impl ViewKind {
    fn words(self) -> &'static str {
        match self {
            Self::Slice => "a slice",
            Self::Isometric => "a block",
            Self::Spheres => "spheres",
        }
    }
}
