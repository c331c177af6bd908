//! One view of a run, drawn again and again on one scale.

use super::cells::wider;
use super::shown::Shown;
use super::{RecordError, Recorder};
use crate::output::picture::Picture;
use crate::view::AnyView;
use clap::ValueEnum;
use xca_core::{Model, Simulation, Snapshot};

/// How a state is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ViewKind {
    /// One layer of cells
    Slice,
    /// All cells as cubes; those that are not 0 of a whole number, else with an octant cut out
    Isometric,
    /// The items of a population
    Spheres,
}

/// What is drawn, and how; what is not said is as in the pictures of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Look {
    pub(crate) substate: Option<String>,
    pub(crate) view: Option<ViewKind>,
    /// The number of the axis that layers are counted along.
    pub(crate) axis: Option<usize>,
    pub(crate) layer: Option<usize>,
    pub(crate) size: Option<[usize; 2]>,
    /// The ends of the scale.
    pub(crate) range: Option<[f64; 2]>,
}

/// A look that does not fit the model.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum LookError {
    #[error("no substate is called `{name}`; there are {known}")]
    NoSubstate { name: String, known: String },
    #[error("`{of}` are substates of {kind}, which cannot be drawn as {view}")]
    View { of: String, kind: &'static str, view: &'static str },
    #[error("this model has no {0} to draw")]
    Nothing(&'static str),
    #[error("--axis and --layer are for slices of cells")]
    NotLayered,
    #[error("there is no layer {layer}: along that axis there are {layers}, from 0")]
    Layer { layer: usize, layers: usize },
}

/// What is drawn of every state.
pub(crate) struct Drawing<'a> {
    recorder: &'a Recorder,
    pub(super) shown: Shown,
    is_block: bool,
    pub(super) look: Look,
}

impl Recorder {
    /// A drawing of this look.
    pub(crate) fn drawing(&self, look: Look) -> Result<Drawing<'_>, LookError> {
        let (original, field) = self.chosen(&look)?;
        let mut shown = Shown::new(original.group, original.view.clone());
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
        if wanted != ViewKind::Slice && (look.axis.is_some() || look.layer.is_some()) {
            return Err(LookError::NotLayered);
        }
        match &mut shown.view {
            AnyView::Items(view) => {
                if let Some((field, name)) = field.filter(|field| !is_named(view.colour.as_ref(), field)) {
                    view.colour = Some((field, name));
                }
            }
            AnyView::Cells(view) => {
                if let Some((field, name)) = field.filter(|field| !is_named(view.drawn.as_ref(), field)) {
                    // The scale and the kinds are those of another substate.
                    (view.drawn, view.range, view.map) = (Some((field, name)), None, None);
                    view.kinds.clear();
                }
                if let Some(axis) = look.axis {
                    (view.axis, view.layer) = (axis, None);
                }
                view.layer = look.layer.or(view.layer);
                let layers = self.model().geometry().extents()[view.axis];
                if let Some(layer) = view.layer.filter(|layer| *layer >= layers) {
                    return Err(LookError::Layer { layer, layers });
                }
                view.range = look.range.or(view.range);
            }
        }
        Ok(Drawing { recorder: self, shown, is_block: wanted == ViewKind::Isometric, look })
    }

    /// The view that shows what is wanted, and the number and the name of its substate where one is named.
    fn chosen(&self, look: &Look) -> Result<(&Shown, Option<Named>), LookError> {
        let Some(name) = &look.substate else {
            let of_items = look.view.map(|view| view == ViewKind::Spheres);
            let found =
                self.shown.iter().find(|shown| of_items.is_none_or(|wanted| shown.is_of_items() == wanted));
            let what = if of_items == Some(true) { "items" } else { "cells" };
            return found.map(|shown| (shown, None)).ok_or(LookError::Nothing(what));
        };
        let fields = |shown: &Shown| {
            let schema = self.model().groups()[shown.group].schema();
            schema.fields.iter().map(|field| field.name).collect::<Vec<_>>()
        };
        for shown in &self.shown {
            if let Some(field) = fields(shown).iter().position(|field| field == name) {
                return Ok((shown, Some((field, name.clone()))));
            }
        }
        let known: Vec<&str> = self.shown.iter().flat_map(fields).collect();
        Err(LookError::NoSubstate { name: name.clone(), known: known.join(", ") })
    }
}

/// The number of a substate, and what it is called.
type Named = (usize, String);

/// Whether a view shows this substate already, and has words for it.
fn is_named(shown: Option<&Named>, (field, _): &Named) -> bool {
    shown.is_some_and(|(shown, _)| shown == field)
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

impl Drawing<'_> {
    pub(crate) fn model(&self) -> &Model {
        self.recorder.model()
    }

    /// The scale, if it does not depend on the states that are drawn.
    pub(crate) fn fixed_range(&self) -> Option<[f64; 2]> {
        match &self.shown.view {
            AnyView::Items(_) => self.look.range,
            AnyView::Cells(view) if view.kinds.is_empty() => view.range,
            // Kinds have no scale.
            AnyView::Cells(_) => Some([0.0; 2]),
        }
    }

    /// `range`, widened to what a state has.
    pub(crate) fn widened(
        &self,
        range: Option<[f64; 2]>,
        simulation: &Simulation,
        snapshot: &Snapshot,
    ) -> Option<[f64; 2]> {
        let cells = self.shown.cells(simulation, snapshot);
        let of_cells =
            cells.and_then(|cells| if self.is_block { cells.whole_range() } else { cells.range() });
        let now = of_cells.or_else(|| self.shown.items(simulation, snapshot).and_then(|items| items.range()));
        match (range, now) {
            (Some(range), now) => Some(wider(range, now)),
            (None, now) => now,
        }
    }

    /// A state on this scale.
    pub(crate) fn picture(
        &self,
        simulation: &Simulation,
        snapshot: &Snapshot,
        range: Option<[f64; 2]>,
    ) -> Result<Option<Picture>, RecordError> {
        let (title, size) = (&self.recorder.set_up.title, self.look.size);
        let caption = self.recorder.caption(snapshot.step);
        Ok(if let Some(items) = self.shown.items(simulation, snapshot) {
            let caption = format!("{caption}, {} {}", items.len(), self.shown.view.name());
            Some(items.draw(title, &caption, range, Some(size.unwrap_or(SIZE)))?)
        } else if let Some(cells) = self.shown.cells(simulation, snapshot) {
            Some(if self.is_block {
                cells.draw_block(title, &caption, range, size.unwrap_or(SIZE))?
            } else {
                cells.draw(title, &caption, range, size)?
            })
        } else {
            None
        })
    }
}

/// Width and height of pictures of items and blocks, in pixels.
const SIZE: [usize; 2] = [800, 600];
