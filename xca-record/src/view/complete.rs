//! The views of a model: those that are given, checked, and plain ones of what no one shows.

use super::{AnyCellView, AnyItemView, AnyView};
use xca_checkpoint::components::Part;
use xca_core::model::GroupKind;
use xca_core::{Model, Schema};

/// A view that does not fit its model.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// The model does not have its substates, or they are not of the kind that the view shows.
    #[error("the view `{view}` shows substates that the model does not have as {kind}")]
    NotInModel {
        /// The name of the view.
        view: String,
        /// `cells` or `items`.
        kind: &'static str,
    },
    /// Two views whose files would have the same names, at least where capitals do not count.
    #[error("the files of the views `{0}` and `{1}` would have the same names; give one another name")]
    SameName(String, String),
    /// A component that the substate does not have.
    #[error("the view `{view}` draws component {component} of `{substate}`, which has {components}")]
    Component {
        /// The name of the view.
        view: String,
        /// The substate.
        substate: &'static str,
        /// The number of the component.
        component: usize,
        /// How many there are.
        components: usize,
    },
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

/// The given views, with the number of the group that each shows, and after them plain views of what no one
/// shows.
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
        if let Some(error) = wrong_component(&view, model.groups()[group].schema()) {
            return Err(error);
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
        let same = |other: &&(usize, AnyView)| other.1.stem().eq_ignore_ascii_case(&view.stem());
        if let Some((_, other)) = views[..number].iter().find(same) {
            return Err(ViewError::SameName(other.name().to_owned(), view.name().to_owned()));
        }
    }
    Ok(views)
}

/// A component that is drawn and that its substate does not have.
fn wrong_component(view: &AnyView, schema: &Schema) -> Option<ViewError> {
    let drawn = match view {
        AnyView::Items(view) => view.colour.as_ref(),
        AnyView::Cells(view) => view.drawn.as_ref(),
    };
    let Part { field, component } = drawn?.quantity.part()?;
    let (field, component) = (schema.fields.get(field)?, component?);
    let components = field.value_type.components();
    (component >= components).then(|| ViewError::Component {
        view: view.name().to_owned(),
        substate: field.name,
        component,
        components,
    })
}
