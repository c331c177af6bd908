//! What of a model's substates is saved and drawn, and how.

mod colours;
mod complete;
mod quantity;

pub(crate) use colours::ValueColour;
pub use complete::ViewError;
pub(crate) use complete::complete;
pub(crate) use quantity::{Computation, Drawn, Quantity, StoredBytes};

use colours::{categories, coloured};
use std::any::TypeId;
use std::marker::PhantomData;
use xca_checkpoint::components::{DrawnPart, Part};
use xca_core::{Field, Geometry, HostValue, Schema, Substate, Substates};
use xca_io::atomic::plain_name;
use xca_picture::{Category, ColourMap};

/// Sets how the items of a population are saved and drawn.
///
/// ```
/// # use xca_core::prelude::*;
/// # #[derive(Substates, Clone)] struct Fish { age: u32, speed: Real }
/// use xca_record::ItemView;
///
/// let view = ItemView::<Fish>::named("fish").radius(0.2).colour(Fish::SPEED, "speed (m/s)");
/// ```
///
/// Default: all items with all substates, as spheres with a diameter of half a cell side. Their colour is the
/// first vector other than the position, else the first other substate.
#[derive(Debug, Clone)]
pub struct ItemView<S> {
    view: AnyItemView,
    of: PhantomData<fn() -> S>,
}

/// Sets how the substates of cells are saved and drawn.
///
/// ```
/// # use xca_core::prelude::*;
/// # #[derive(Substates, Clone)] struct Plate { temperature: Real }
/// use xca_record::CellView;
/// let view = CellView::<Plate>::named("plate").draw(Plate::TEMPERATURE, "temperature (K)").axes(true);
/// ```
///
/// Default: all substates are saved, and the first is drawn, in the middle layer. `bool` and states have one
/// colour for each value, and a legend.
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
    /// The columns of the table; all substates where there are none.
    pub(crate) columns: Vec<TableColumn>,
    pub(crate) radius: Option<f64>,
    pub(crate) colour: Option<Drawn>,
    pub(crate) colours: Vec<ValueColour>,
}

/// A column of a table of items.
#[derive(Debug, Clone)]
pub(crate) struct TableColumn {
    pub(crate) header: String,
    /// The number of the substate.
    pub(crate) field: usize,
    pub(crate) component: usize,
}

impl TableColumn {
    /// A column for each component of each substate. Those of the position are `x`, `y` and `z`.
    pub(crate) fn all(schema: &Schema) -> Vec<Self> {
        let of_field = |(field, definition): (usize, &Field)| {
            let is_position = schema.position == Some(field);
            let names = definition.value_type.component_names().into_iter().enumerate();
            let columns = names.map(move |(component, name)| {
                let header = match name.as_str() {
                    "" => definition.name.to_owned(),
                    lane if is_position => lane.to_owned(),
                    component => format!("{}_{component}", definition.name),
                };
                Self { header, field, component }
            });
            columns.collect::<Vec<_>>()
        };
        schema.fields.iter().enumerate().flat_map(of_field).collect()
    }
}

/// [`CellView`] with its substates by number.
#[derive(Debug, Clone)]
pub(crate) struct AnyCellView {
    pub(crate) group: TypeId,
    pub(crate) name: String,
    pub(crate) drawn: Option<Drawn>,
    pub(crate) layer: Option<usize>,
    /// The axis that the layers are counted along: z but for `render`.
    pub(crate) axis: usize,
    pub(crate) range: Option<[f64; 2]>,
    pub(crate) map: Option<ColourMap>,
    pub(crate) kinds: Vec<(f64, String)>,
    pub(crate) colours: Vec<ValueColour>,
    /// The substate that it is drawn over, and the value up to which that is seen.
    pub(crate) relief: Option<(usize, f64)>,
    /// Whether all cells are drawn, as cubes: only by `render`.
    pub(crate) block: bool,
    /// Whether slices have axes; on a map unless it is said.
    pub(crate) axes: Option<bool>,
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

    /// Adds columns to the table of items, one for each component of a substate. Substates without a column
    /// are then saved nowhere.
    #[must_use]
    pub fn columns<V: HostValue, const N: usize>(
        mut self,
        substate: Substate<S, V>,
        headers: [&str; N],
    ) -> Self {
        const { assert!(N == V::COMPONENTS, "one header for each component of the substate") };
        let field = substate.index();
        let columns = headers.iter().enumerate();
        self.view.columns.extend(columns.map(|(component, header)| TableColumn {
            header: (*header).to_owned(),
            field,
            component,
        }));
        self
    }

    /// The radius of an item, in metres.
    #[must_use]
    pub fn radius(mut self, metres: f64) -> Self {
        self.view.radius = Some(metres);
        self
    }

    /// Colours items by a substate: a number, `bool` or a state; of a vector its length, of an array the sum
    /// of its elements. `^` in the label raises what follows: `speed (m s^-1)`.
    #[must_use]
    pub fn colour<V: HostValue>(mut self, substate: Substate<S, V>, label: impl Into<String>) -> Self {
        let part = Part { field: substate.index(), component: None };
        self.view.colour = Some(Drawn { quantity: Quantity::Part(part), label: label.into() });
        self
    }

    /// Colours items by one component of a substate: a lane of a vector, an element of an array. The lanes of
    /// an array of vectors are numbered one element after the other.
    #[must_use]
    pub fn colour_component<V: HostValue>(
        mut self,
        substate: Substate<S, V>,
        component: usize,
        label: impl Into<String>,
    ) -> Self {
        let part = Part { field: substate.index(), component: Some(component) };
        self.view.colour = Some(Drawn { quantity: Quantity::Part(part), label: label.into() });
        self
    }

    /// Colours items by a number that is computed of their substates, such as an energy.
    #[must_use]
    pub fn colour_with(
        mut self,
        label: impl Into<String>,
        quantity: impl Fn(&S) -> f64 + Send + Sync + 'static,
    ) -> Self {
        let quantity = Quantity::Computed(Computation::of(quantity));
        self.view.colour = Some(Drawn { quantity, label: label.into() });
        self
    }

    /// The colours (sRGB) of some values of a substate: of states, `true` and `false`. Others keep those of
    /// the palette.
    #[must_use]
    pub fn colours<V: HostValue>(
        mut self,
        substate: Substate<S, V>,
        colours: &[(V::Scalar, [u8; 3])],
    ) -> Self {
        self.view.colours.extend(ValueColour::all(substate, colours));
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

    /// Draws a substate: a number, `bool` or a state; of a vector its length, of an array the sum of its
    /// elements (of vectors, the length of the sum; of `bool`, how many are true; of states, the first
    /// element).
    #[must_use]
    pub fn draw<V: HostValue>(mut self, substate: Substate<S, V>, label: impl Into<String>) -> Self {
        let part = Part { field: substate.index(), component: None };
        self.view.drawn = Some(Drawn { quantity: Quantity::Part(part), label: label.into() });
        self
    }

    /// Draws one component of a substate: a lane of a vector, an element of an array. The lanes of an array
    /// of vectors are numbered one element after the other.
    #[must_use]
    pub fn draw_component<V: HostValue>(
        mut self,
        substate: Substate<S, V>,
        component: usize,
        label: impl Into<String>,
    ) -> Self {
        let part = Part { field: substate.index(), component: Some(component) };
        self.view.drawn = Some(Drawn { quantity: Quantity::Part(part), label: label.into() });
        self
    }

    /// Draws a number that is computed of the substates of a cell.
    ///
    /// ```
    /// use xca_core::prelude::*;
    /// use xca_record::CellView;
    ///
    /// #[derive(Substates, Clone)]
    /// struct Land {
    ///     altitude: Real,
    ///     thickness: Real,
    /// }
    ///
    /// let view = CellView::<Land>::named("surface")
    ///     .draw_with("surface (m)", |cell: &Land| cell.altitude + cell.thickness);
    /// ```
    #[must_use]
    pub fn draw_with(
        mut self,
        label: impl Into<String>,
        quantity: impl Fn(&S) -> f64 + Send + Sync + 'static,
    ) -> Self {
        let quantity = Quantity::Computed(Computation::of(quantity));
        self.view.drawn = Some(Drawn { quantity, label: label.into() });
        self
    }

    /// The colours (sRGB) of some values of a substate: of states, `true` and `false`, or of [`Self::kinds`].
    /// Others keep those of the palette.
    ///
    /// ```
    /// use xca_core::prelude::*;
    /// use xca_record::CellView;
    ///
    /// #[derive(States, Clone, Copy, PartialEq)]
    /// enum Ground {
    ///     Rock,
    ///     Water,
    /// }
    ///
    /// #[derive(Substates, Clone)]
    /// struct Land {
    ///     ground: Ground,
    /// }
    ///
    /// let view = CellView::<Land>::named("land").colours(Land::GROUND, &[(Ground::Water, [60, 120, 200])]);
    /// ```
    #[must_use]
    pub fn colours<V: HostValue>(
        mut self,
        substate: Substate<S, V>,
        colours: &[(V::Scalar, [u8; 3])],
    ) -> Self {
        self.view.colours.extend(ValueColour::all(substate, colours));
        self
    }

    /// Draws the layer with this index along z.
    #[must_use]
    pub fn layer(mut self, z: usize) -> Self {
        self.view.layer = Some(z);
        self
    }

    /// Draws over the relief of the ground, whose heights in metres are another substate: where the drawn one
    /// is not more than `bare`, the ground is seen.
    #[must_use]
    pub fn relief<V: HostValue + Into<f64>>(mut self, heights: Substate<S, V>, bare: f64) -> Self {
        self.view.relief = Some((heights.index(), bare));
        self
    }

    /// The values at the ends of the scale. Without it, they are the least and the largest of the initial
    /// state, or of the state that is drawn where it goes beyond.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.view.range = Some([low, high]);
        self
    }

    /// Whether pictures of layers have axes in metres, in place of a scale. Default: where the cells lie on a
    /// map. The axes then tell its eastings and northings.
    #[must_use]
    pub fn axes(mut self, are_drawn: bool) -> Self {
        self.view.axes = Some(are_drawn);
        self
    }

    /// The colours of the scale.
    #[must_use]
    pub fn map(mut self, map: ColourMap) -> Self {
        self.view.map = Some(map);
        self
    }

    /// Names for the values of a number that stands for kinds. States and `bool` have names of their own.
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
        let (columns, colours) = (Vec::new(), Vec::new());
        Self { group, name, only: None, columns, radius: None, colour: None, colours }
    }

    /// What colours the items.
    pub(crate) fn colour(&self, schema: &Schema) -> Option<Drawn> {
        let default = || {
            let other = |field: &usize| schema.position != Some(*field);
            let vector = (0..schema.fields.len())
                .filter(other)
                .find(|&field| schema.fields[field].value_type.lanes > 1);
            let field = vector.or_else(|| (0..schema.fields.len()).find(other))?;
            let value_type = schema.fields[field].value_type;
            let label = DrawnPart::of(value_type, None).label(&schema.fields[field]);
            Some(Drawn { quantity: Quantity::Part(Part { field, component: None }), label })
        };
        self.colour.clone().or_else(default)
    }

    /// The states that colour the items; none where a number does.
    pub(crate) fn categories(&self, schema: &Schema) -> Vec<Category> {
        let colour = self.colour(schema);
        // White spheres are hard to see on the ground.
        colour.map(|drawn| categories(schema, &drawn.quantity, &self.colours, 1)).unwrap_or_default()
    }
}

impl AnyCellView {
    fn plain(group: TypeId, name: String) -> Self {
        Self {
            group,
            name,
            drawn: None,
            layer: None,
            axis: 2,
            range: None,
            map: None,
            kinds: Vec::new(),
            colours: Vec::new(),
            relief: None,
            block: false,
            axes: None,
        }
    }

    /// What is drawn.
    pub(crate) fn quantity(&self) -> Quantity {
        let first = Quantity::Part(Part { field: 0, component: None });
        self.drawn.as_ref().map_or(first, |drawn| drawn.quantity.clone())
    }

    /// What the scale calls it.
    pub(crate) fn label(&self, schema: &Schema) -> String {
        let default = || {
            let field = schema.fields.first();
            field.map_or_else(String::new, |field| DrawnPart::of(field.value_type, None).label(field))
        };
        self.drawn.as_ref().map_or_else(default, |drawn| drawn.label.clone())
    }

    /// The kinds or states of what is drawn; none where it is a number.
    pub(crate) fn categories(&self, schema: &Schema) -> Vec<Category> {
        let quantity = self.quantity();
        if self.kinds.is_empty() {
            categories(schema, &quantity, &self.colours, 0)
        } else {
            coloured(self.kinds.iter().cloned(), quantity.field(), &self.colours, 0)
        }
    }

    /// The layer that is drawn.
    pub(crate) fn drawn_layer(&self, geometry: &Geometry) -> usize {
        self.layer.unwrap_or(geometry.extents()[self.axis] / 2)
    }
}

impl AnyView {
    /// Its name in those of files.
    pub(crate) fn stem(&self) -> String {
        plain_name(self.name())
    }

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
