//! From what a view sees of a state to its picture.

use super::cells;
use super::seen::{Seen, wider};
use super::shown::{LengthScale, Shown};
use crate::format::Subject;
use crate::view::{AnyCellView, AnyItemView, AnyView, Drawn};
use xca_core::model::Group;
use xca_core::{Geometry, Model, Schema};
use xca_io::map::MapUnit;
use xca_picture::{
    Axes, BlockPicture, Category, ColourMap, Domain, LandscapePicture, Lattice, ParticlePicture, Picture,
    PictureError, Relief, Scalar, SlicePicture,
};

/// The texts above a picture, its scale and its size.
#[derive(Clone, Copy)]
pub(crate) struct Frame<'a> {
    pub(crate) title: &'a str,
    pub(crate) caption: &'a str,
    /// For cells, the scale of earlier pictures, which is widened to what there is; for items, the scale.
    pub(crate) range: Option<[f64; 2]>,
    /// Width and height in pixels; those of the kind of picture unless they are given.
    pub(crate) size: Option<[usize; 2]>,
}

/// A substate of cells that is painted.
pub(super) struct Field<'a> {
    pub(super) view: &'a AnyCellView,
    pub(super) schema: &'a Schema,
    pub(super) geometry: &'a Geometry,
    pub(super) label: &'a str,
    pub(super) is_float: bool,
    pub(super) values: &'a [f64],
    /// Of the ground, where it is drawn over one.
    pub(super) heights: Option<&'a [f64]>,
    /// The cells that are not drawn.
    pub(super) hidden: Option<&'a [bool]>,
    /// The corner of the cells, if they lie on a map.
    pub(super) corner: Option<[f64; 2]>,
    pub(super) scale: LengthScale,
}

impl Shown {
    /// What has to be said of a picture of this view beside its step. That layers are counted along z goes
    /// without saying, unless there are `others` beside it.
    pub(super) fn details(&self, model: &Model, seen: &Seen, others: bool) -> Option<String> {
        match (&self.view, seen) {
            (AnyView::Items(view), Seen::Items { positions, .. }) => {
                Some(format!("{} {}", positions.len(), view.name))
            }
            (AnyView::Cells(view), _) => {
                let layers = model.geometry().extents()[view.axis];
                let axis = ["along x", "along y", if others { "along z" } else { "" }][view.axis];
                let layer = view.drawn_layer(model.geometry());
                let of_layers = || format!("layer {layer} of {layers} {axis}").trim_end().to_owned();
                (layers > 1 && !view.block).then(of_layers)
            }
            _ => None,
        }
    }

    /// The step, and what else has to be said of a picture of this view alone.
    pub(crate) fn whole_caption(&self, subject: Subject<'_>, seen: &Seen, step: u64) -> String {
        let details = self.details(subject.model(), seen, false);
        [Some(subject.caption(step)), details].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// The picture of what this view sees.
    pub(crate) fn paint(
        &self,
        model: &Model,
        seen: &Seen,
        frame: Frame<'_>,
    ) -> Result<Option<Picture>, PictureError> {
        let (group, geometry) = (&model.groups()[self.group], model.geometry());
        Ok(match (&self.view, seen) {
            (AnyView::Items(view), Seen::Items { positions, values }) => {
                let range = frame.range.or_else(|| seen.range());
                let spheres = Spheres { view, group, geometry, unit: self.scale(geometry).unit() };
                Some(spheres.paint((positions, values), Frame { range, ..frame })?)
            }
            (AnyView::Cells(view), Seen::Cells { is_float, values, heights, hidden }) => {
                let schema = group.schema();
                let label = view.label(schema);
                let (heights, hidden, is_float) = (heights.as_deref(), hidden.as_deref(), *is_float);
                let (label, corner, scale) = (label.as_str(), self.corner_on_map(), self.scale(geometry));
                let field =
                    Field { view, schema, geometry, label, is_float, values, heights, hidden, corner, scale };
                let range = seen.range();
                let layer = Layer {
                    cells: field.plane().0,
                    lattice: field.lattice(),
                    has_axes: view.axes.unwrap_or(corner.is_some()),
                };
                Some(if view.block {
                    field.block(frame, range)?
                } else {
                    field.slice(frame, range, layer)?
                })
            }
            _ => None,
        })
    }
}

impl Shown {
    /// A picture of so many rows of cells, the lowest first.
    pub(crate) fn paint_rows(
        &self,
        model: &Model,
        seen: &Seen,
        rows: usize,
        frame: Frame<'_>,
    ) -> Result<Option<Picture>, PictureError> {
        let (AnyView::Cells(view), Seen::Cells { is_float, values, .. }) = (&self.view, seen) else {
            return Ok(None);
        };
        let (schema, geometry) = (model.groups()[self.group].schema(), model.geometry());
        let (label, is_float) = (view.label(schema), *is_float);
        let (label, heights, hidden, corner) = (label.as_str(), None, None, None);
        let scale = Self::new(self.group, self.view.clone(), None).scale(geometry);
        let field = Field { view, schema, geometry, label, is_float, values, heights, hidden, corner, scale };
        let cells = [geometry.extents()[0], rows];
        let layer = Layer { cells, lattice: Lattice::Squares, has_axes: false };
        field.slice(frame, seen.range(), layer).map(Some)
    }
}

/// What is drawn flat.
struct Layer {
    /// Cells across and down.
    cells: [usize; 2],
    lattice: Lattice,
    has_axes: bool,
}

/// An axis of the space.
struct SpaceAxis {
    name: &'static str,
    /// The coordinate of the first face of the space.
    begin: f64,
}

/// Items that are drawn as spheres.
struct Spheres<'a> {
    view: &'a AnyItemView,
    group: &'a Group,
    geometry: &'a Geometry,
    /// That of lengths.
    unit: &'a str,
}

impl Spheres<'_> {
    fn paint(
        &self,
        (positions, values): (&[[f64; 3]], &[f64]),
        frame: Frame<'_>,
    ) -> Result<Picture, PictureError> {
        let Self { view, group, geometry, unit } = *self;
        let colour = view.colour(group.schema());
        let radius = view.radius.unwrap_or(geometry.side() / 4.0);
        let domain = Domain { lower: [0.0; 3], upper: cells::sides(geometry) };
        let mut picture = ParticlePicture::new(positions, radius, domain);
        picture.colour = colour
            .as_ref()
            .map(|Drawn { label, .. }| Scalar { range: frame.range, ..Scalar::new(label, values) });
        let categories = view.categories(group.schema());
        picture.categories = &categories;
        picture.length_unit = unit;
        picture.size = frame.size.unwrap_or(picture.size);
        (picture.title, picture.caption) = (frame.title, frame.caption);
        picture.render()
    }
}

impl Field<'_> {
    /// Draws a layer. The picture has its natural size unless one is given.
    fn slice(
        &self,
        frame: Frame<'_>,
        present: Option<[f64; 2]>,
        layer: Layer,
    ) -> Result<Picture, PictureError> {
        let [across, down] = layer.cells;
        let kinds = self.kinds(frame.range);
        let mut picture = SlicePicture::new(across, down, self.scalar(frame.range, present));
        picture.categories = &kinds;
        picture.lattice = layer.lattice;
        let relief = self.heights.zip(self.view.relief);
        picture.relief = relief.map(|(heights, (_, bare))| Relief { heights, bare });
        picture.hidden = self.hidden;
        (picture.title, picture.caption) = (frame.title, frame.caption);
        picture.size = frame.size;
        // A side of 1 is also that of a scale in cells.
        picture.cell_side = self.geometry.side();
        picture.length_unit = self.scale.unit();
        let unit = picture.length_unit;
        let names = self.axes().map(|axis| format!("{} ({unit})", axis.name));
        if layer.has_axes {
            let names = names.each_ref().map(String::as_str);
            picture.axes = Some(Axes { names, corner: self.axes().map(|axis| axis.begin) });
        }
        picture.render()
    }

    /// The axes of a layer, across and up.
    fn axes(&self) -> [SpaceAxis; 2] {
        let [x, y] = self.corner.unwrap_or_default();
        let names = match self.corner {
            None => ["x", "y", "z"],
            Some(_) if self.scale == LengthScale::Of(MapUnit::Degree) => ["longitude", "latitude", "z"],
            Some(_) => ["easting", "northing", "z"],
        };
        let begins = [x, y, 0.0];
        let across = match self.view.axis {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        };
        across.map(|axis| SpaceAxis { name: names[axis], begin: begins[axis] })
    }

    /// Draws all cells, or those that are not 0 where the substate is a whole number; one layer over its
    /// relief.
    fn block(&self, frame: Frame<'_>, present: Option<[f64; 2]>) -> Result<Picture, PictureError> {
        let kinds = self.kinds(frame.range);
        if let Some((heights, (_, bare))) = self.heights.zip(self.view.relief) {
            let relief = Relief { heights, bare };
            let scalar = self.scalar(frame.range, present);
            let [columns, rows, _] = self.geometry.extents();
            let mut picture = LandscapePicture::new([columns, rows], self.geometry.side(), scalar, relief);
            (picture.categories, picture.hidden) = (&kinds, self.hidden);
            (picture.title, picture.caption) = (frame.title, frame.caption);
            picture.size = frame.size.unwrap_or(picture.size);
            return picture.render();
        }
        let mut picture = BlockPicture::new(self.geometry.extents(), self.scalar(frame.range, present));
        picture.categories = &kinds;
        // In a single layer nothing is hidden that an empty cell would show.
        let is_flat = self.geometry.extents()[2] == 1;
        picture.hidden = self.hidden;
        picture.empty = (!self.is_float && !is_flat).then_some(0.0);
        (picture.title, picture.caption) = (frame.title, frame.caption);
        picture.size = frame.size.unwrap_or(picture.size);
        picture.render()
    }

    /// How the cells of the layer lie.
    fn lattice(&self) -> Lattice {
        if self.view.axis == 2 { cells::lattice(self.geometry) } else { Lattice::Squares }
    }

    /// The cells of a layer across and down, and the number of layers.
    pub(super) fn plane(&self) -> ([usize; 2], usize) {
        let [columns, rows, layers] = self.geometry.extents();
        match self.view.axis {
            0 => ([rows, layers], columns),
            1 => ([columns, layers], rows),
            _ => ([columns, rows], layers),
        }
    }

    /// The values with their colours.
    pub(super) fn scalar(&self, earlier: Option<[f64; 2]>, present: Option<[f64; 2]>) -> Scalar<'_> {
        let mut scalar = Scalar::new(self.label, self.values);
        let of_type = if self.is_float { ColourMap::Sequential } else { ColourMap::Paper };
        scalar.map = self.view.map.unwrap_or(of_type);
        scalar.range = self.view.range.or(earlier.map(|earlier| wider(earlier, present)));
        scalar
    }

    /// The values that are kinds or states rather than magnitudes, with their names.
    pub(super) fn kinds(&self, range: Option<[f64; 2]>) -> Vec<Category> {
        let view = self.view;
        let categories = view.categories(self.schema);
        let is_plain = categories.is_empty() && view.map.is_none() && view.range.is_none();
        let values = self.values.iter().enumerate();
        let is_drawn = |cell: usize| self.hidden.is_none_or(|hidden| hidden.get(cell) != Some(&true));
        let drawn = values.filter(|(cell, _)| is_drawn(*cell)).map(|(_, value)| *value);
        let mut all = drawn.chain(range.into_iter().flatten());
        // Cells that are 0 or 1 need no scale.
        if is_plain && !self.is_float && all.all(|value| [0.0, 1.0].contains(&value)) {
            return vec![Category::new(0, 0.0, "0"), Category::new(1, 1.0, "1")];
        }
        categories
    }
}
