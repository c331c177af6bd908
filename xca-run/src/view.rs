//! What of a model's substates is saved and drawn, and how.

use crate::output::picture::ColourMap;
use std::any::TypeId;
use std::marker::PhantomData;
use xca_core::model::GroupKind;
use xca_core::{Geometry, HostValue, Model, Schema, Substate, Substates};

/// How the items of a population are saved and drawn.
///
/// What is not said follows from the substates: all items with all substates, as spheres of half a cell's side, coloured by the length of
/// the first vector beside the position.
#[derive(Debug, Clone)]
pub struct ItemView<S> {
    view: AnyItemView,
    of: PhantomData<fn() -> S>,
}

/// How the substates of cells are saved and drawn.
///
/// What is not said follows from the substates: all are saved, and the first is drawn, in the middle layer.
#[derive(Debug, Clone)]
pub struct CellView<S> {
    view: AnyCellView,
    of: PhantomData<fn() -> S>,
}

/// A view of any substates.
#[derive(Debug, Clone)]
pub(crate) enum AnyView {
    Items(AnyItemView),
    Cells(AnyCellView),
}

/// [`ItemView`] with its substates by number.
#[derive(Debug, Clone)]
pub(crate) struct AnyItemView {
    pub(crate) group: TypeId,
    pub(crate) name: String,
    /// The items that are shown: those where this substate has this value.
    pub(crate) only: Option<(usize, f64)>,
    /// Columns of the table: header, number of the substate, lane.
    pub(crate) columns: Vec<(String, usize, usize)>,
    pub(crate) radius: Option<f64>,
    /// The number of the substate and what it is called.
    pub(crate) colour: Option<(usize, String)>,
}

/// [`CellView`] with its substates by number.
#[derive(Debug, Clone)]
pub(crate) struct AnyCellView {
    pub(crate) group: TypeId,
    pub(crate) name: String,
    /// The number of the substate and what it is called.
    pub(crate) drawn: Option<(usize, String)>,
    pub(crate) layer: Option<usize>,
    /// The axis that the layers are counted along: z but for `render`.
    pub(crate) axis: usize,
    pub(crate) range: Option<[f64; 2]>,
    pub(crate) map: Option<ColourMap>,
    pub(crate) kinds: Vec<(f64, String)>,
    /// The substate that it is drawn over, and the value up to which that is seen.
    pub(crate) relief: Option<(usize, f64)>,
    /// Whether all cells are drawn, as cubes: only by `render`.
    pub(crate) block: bool,
}

impl<S: Substates> ItemView<S> {
    /// A view of the items of `S`, whose files begin with this name.
    pub fn named(name: impl Into<String>) -> Self {
        Self { view: AnyItemView::plain(TypeId::of::<S>(), name.into()), of: PhantomData }
    }

    /// Shows only the items where a substate has this value.
    #[must_use]
    pub fn only<V: HostValue + Into<f64>>(mut self, substate: Substate<S, V>, value: V) -> Self {
        self.view.only = Some((substate.index(), value.into()));
        self
    }

    /// Adds columns to the table of items, one for each lane of a substate. Substates without a column are then saved nowhere.
    #[must_use]
    pub fn columns<V: HostValue, const N: usize>(
        mut self,
        substate: Substate<S, V>,
        headers: [&str; N],
    ) -> Self {
        const { assert!(N == V::COMPONENTS, "one header for each component of the substate") };
        let columns = headers.iter().enumerate();
        self.view
            .columns
            .extend(columns.map(|(lane, header)| ((*header).to_owned(), substate.index(), lane)));
        self
    }

    /// The radius of an item, in metres.
    #[must_use]
    pub fn radius(mut self, metres: f64) -> Self {
        self.view.radius = Some(metres);
        self
    }

    /// Colours items by a substate: a number, or the length of a vector. `^` in the label raises what follows: `speed (m s^-1)`.
    #[must_use]
    pub fn colour<V: HostValue>(mut self, substate: Substate<S, V>, label: impl Into<String>) -> Self {
        self.view.colour = Some((substate.index(), label.into()));
        self
    }

    pub(crate) fn into_any(self) -> AnyItemView {
        self.view
    }
}

impl<S: Substates> CellView<S> {
    /// A view of the substates `S`, whose files begin with this name.
    pub fn named(name: impl Into<String>) -> Self {
        Self { view: AnyCellView::plain(TypeId::of::<S>(), name.into()), of: PhantomData }
    }

    /// Draws a substate: a number, or the length of a vector.
    #[must_use]
    pub fn draw<V: HostValue>(mut self, substate: Substate<S, V>, label: impl Into<String>) -> Self {
        self.view.drawn = Some((substate.index(), label.into()));
        self
    }

    /// Draws the layer with this index along z.
    #[must_use]
    pub fn layer(mut self, z: usize) -> Self {
        self.view.layer = Some(z);
        self
    }

    /// Draws over the relief of the ground, whose heights in metres are another substate: where the drawn one is not more than `bare`, the
    /// ground is seen.
    #[must_use]
    pub fn relief<V: HostValue + Into<f64>>(mut self, heights: Substate<S, V>, bare: f64) -> Self {
        self.view.relief = Some((heights.index(), bare));
        self
    }

    /// The values at the ends of the scale. Without it, they are the least and the largest of the initial state, or of the state that is drawn
    /// where it goes beyond.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.view.range = Some([low, high]);
        self
    }

    /// The colours of the scale.
    #[must_use]
    pub fn map(mut self, map: ColourMap) -> Self {
        self.view.map = Some(map);
        self
    }

    /// The values are no magnitudes but kinds, each with its name.
    #[must_use]
    pub fn kinds<K: Into<f64> + Copy>(mut self, kinds: &[(K, &str)]) -> Self {
        self.view.kinds = kinds.iter().map(|(value, name)| ((*value).into(), (*name).to_owned())).collect();
        self
    }

    pub(crate) fn into_any(self) -> AnyCellView {
        self.view
    }
}

impl AnyItemView {
    fn plain(group: TypeId, name: String) -> Self {
        Self { group, name, only: None, columns: Vec::new(), radius: None, colour: None }
    }

    /// The substate that colours the items, and what it is called.
    pub(crate) fn colour(&self, schema: &Schema) -> Option<(usize, String)> {
        let default = || {
            let other = |field: &usize| schema.position != Some(*field);
            let vector = (0..schema.fields.len())
                .filter(other)
                .find(|&field| schema.fields[field].value_type.lanes > 1);
            let field = vector.or_else(|| (0..schema.fields.len()).find(other))?;
            let name = schema.fields[field].name;
            Some((field, if vector.is_some() { format!("length of {name}") } else { name.to_owned() }))
        };
        self.colour.clone().or_else(default)
    }
}

impl AnyCellView {
    fn plain(group: TypeId, name: String) -> Self {
        let (drawn, layer, range, map) = (None, None, None, None);
        Self { group, name, drawn, layer, axis: 2, range, map, kinds: Vec::new(), relief: None, block: false }
    }

    /// The number of the substate that is drawn.
    pub(crate) fn field(&self) -> usize {
        self.drawn.as_ref().map_or(0, |(field, _)| *field)
    }

    /// What that substate is called.
    pub(crate) fn label<'a>(&'a self, schema: &Schema) -> &'a str {
        let first = schema.fields.first().map_or("", |field| field.name);
        self.drawn.as_ref().map_or(first, |(_, label)| label)
    }

    /// The layer that is drawn.
    pub(crate) fn drawn_layer(&self, geometry: &Geometry) -> usize {
        self.layer.unwrap_or(geometry.extents()[self.axis] / 2)
    }
}

impl AnyView {
    pub(crate) fn name(&self) -> &str {
        match self {
            Self::Items(view) => &view.name,
            Self::Cells(view) => &view.name,
        }
    }

    fn group(&self) -> TypeId {
        match self {
            Self::Items(view) => view.group,
            Self::Cells(view) => view.group,
        }
    }
}

/// A view that does not fit its model.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ViewError {
    /// The model does not have its substates, or they are not of the kind that the view shows.
    #[error("the view `{view}` shows substates that the model does not have as {kind}")]
    NotInModel {
        /// The name of the view.
        view: String,
        /// `cells` or `items`.
        kind: &'static str,
    },
    /// Two views whose files would have the same names.
    #[error("two views are named `{0}`; their files would have the same names")]
    SameName(String),
    /// A layer that the space does not have.
    #[error("the view `{view}` draws layer {layer}, but the space has {layers} layers")]
    Layer {
        /// The name of the view.
        view: String,
        /// The layer.
        layer: usize,
        /// How many there are.
        layers: usize,
    },
}

/// The given views, with the number of the group that each shows, and after them plain views of what no one shows.
pub(crate) fn complete(model: &Model, given: Vec<AnyView>) -> Result<Vec<(usize, AnyView)>, ViewError> {
    let mut views = Vec::new();
    for view in given {
        let found = model.group_number(view.group());
        let fits = found.is_some_and(|group| {
            matches!(
                (&view, model.groups()[group].kind()),
                (AnyView::Items(_), GroupKind::Population { .. })
                    | (AnyView::Cells(_), GroupKind::Cells { .. })
            )
        });
        let (Some(group), true) = (found, fits) else {
            let kind = if matches!(view, AnyView::Items(_)) { "items" } else { "cells" };
            return Err(ViewError::NotInModel { view: view.name().to_owned(), kind });
        };
        if let AnyView::Cells(AnyCellView { layer: Some(layer), name, .. }) = &view {
            let [_, _, layers] = model.geometry().extents();
            if *layer >= layers {
                return Err(ViewError::Layer { view: name.clone(), layer: *layer, layers });
            }
        }
        views.push((group, view));
    }
    for (number, group) in model.groups().iter().enumerate() {
        if views.iter().all(|(shown, _)| *shown != number) {
            let name = group.schema().name.to_lowercase();
            let view = match group.kind() {
                GroupKind::Population { .. } => AnyView::Items(AnyItemView::plain(group.type_id(), name)),
                GroupKind::Cells { .. } => AnyView::Cells(AnyCellView::plain(group.type_id(), name)),
            };
            views.push((number, view));
        }
    }
    for (number, (_, view)) in views.iter().enumerate() {
        if views[..number].iter().any(|(_, other)| other.name() == view.name()) {
            return Err(ViewError::SameName(view.name().to_owned()));
        }
    }
    Ok(views)
}
