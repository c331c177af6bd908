//! Pictures of one layer of a dense substate.

use super::averaging::fitted_layer;
use super::axes::{Axes, Drawn};
use super::canvas::{Canvas, Strokes};
use super::category::Category;
use super::colour::encode;
use super::legend::{FAINT_INK, INK, Scalar, draw_bar, draw_categories, draw_title};
use super::mosaic::{Mosaic, Palette};
use super::relief::{Ground, Relief};
use super::text::{self, Anchor, Style};
use super::{Picture, PictureError, check_size};
use xca_io::lattice::Lattice;
use xca_io::numbers::significant;

const LEFT: usize = 36;
/// The room for the labels of an axis, in pixels.
const LEFT_OF_AXES: usize = 96;
const TOP: usize = 96;
/// The room above the drawing with the name of an axis, in pixels.
const TOP_OF_AXES: usize = 120;
const BOTTOM: usize = 64;
/// The room for the bar or the list of categories, in pixels.
const RIGHT: usize = 176;
/// The distance from the drawing to the bar or list, in pixels.
const BAR: usize = 34;
/// The least width of a drawing with axes, unless it may be wider.
const LEAST_WITH_AXES: usize = 200;

/// One layer of a dense substate, one colour per cell, x to the right and y upwards.
///
/// Square cells become squares of a whole number of pixels if there is room. If there are more cells than
/// pixels, a pixel shows the mean of its cells.
#[derive(Debug, Clone)]
pub struct SlicePicture<'a> {
    /// The number of cells along x.
    pub columns: usize,
    /// The number of cells along y.
    pub rows: usize,
    /// The arrangement of the cells: squares or hexagons.
    pub lattice: Lattice,
    /// The values, `columns * rows` of them, x fastest, the lowest y first.
    pub scalar: Scalar<'a>,
    /// The categories of the values, if not empty. Other values are drawn in grey.
    pub categories: &'a [Category],
    /// The relief below the layer, if there is one.
    pub relief: Option<Relief<'a>>,
    /// The hidden cells, in the order of the values. The background shows where this is true.
    pub hidden: Option<&'a [bool]>,
    /// The text above the picture.
    pub title: &'a str,
    /// The smaller text below the title.
    pub caption: &'a str,
    /// The side of a cell in `length_unit`, for the scale below the picture. For a hexagon, the distance to
    /// its neighbours.
    pub cell_side: f64,
    /// The unit of length.
    pub length_unit: &'a str,
    /// The coordinates along the left and the lower edge. They replace the scale, and are left out if `size`
    /// has no room for them.
    pub axes: Option<Axes<'a>>,
    /// The longer side of the drawing without the surrounding text, in pixels, at most. From 200 to 7900.
    pub pixels: usize,
    /// Width and height of the whole picture in pixels, if they are fixed. `pixels` is then ignored.
    pub size: Option<[usize; 2]>,
}

impl<'a> SlicePicture<'a> {
    /// A picture of at most 768 pixels each way, with a scale in cells, without text.
    #[must_use]
    pub fn new(columns: usize, rows: usize, scalar: Scalar<'a>) -> Self {
        Self {
            columns,
            rows,
            lattice: Lattice::Squares,
            scalar,
            categories: &[],
            relief: None,
            hidden: None,
            title: "",
            caption: "",
            cell_side: 1.0,
            length_unit: "cells",
            axes: None,
            pixels: 768,
            size: None,
        }
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// [`PictureError::NoCells`], [`PictureError::Length`] (one value for each cell) and
    /// [`PictureError::Size`].
    pub fn render(&self) -> Result<Picture, PictureError> {
        let Self { columns, rows, .. } = *self;
        if columns == 0 || rows == 0 {
            return Err(PictureError::NoCells { columns, rows });
        }
        let cells = columns.saturating_mul(rows);
        self.scalar.check(cells, "cells")?;
        if let Some(Relief { heights, .. }) = self.relief {
            Scalar::new("heights", heights).check(cells, "cells")?;
        }
        let [plate, drawing] = self.plate_and_drawing()?;
        let [left, top] = self.margins();
        let size = [left + plate[0] + RIGHT, top + plate[1] + BOTTOM];
        check_size(size)?;
        let mut canvas = Canvas::new(size[0], size[1], [1.0; 3]);
        let corner = [left + (plate[0] - drawing[0]) / 2, top + (plate[1] - drawing[1]) / 2];
        self.draw_cells(&mut canvas, corner, drawing);
        canvas.frame(corner, drawing, INK);
        draw_title(&mut canvas, LEFT as f32, self.title, self.caption);
        let lengths = self.lattice.size([self.columns, self.rows]).map(|length| length * self.cell_side);
        if let Some(axes) = self.axes() {
            let columns = [14.0, (left + plate[0] + BAR - 4) as f32];
            axes.draw(&mut canvas, &Drawn { corner, size: drawing, lengths, columns });
        } else {
            self.draw_scale(&mut canvas, [corner[0], corner[1] + drawing[1]], drawing[0], lengths[0]);
        }
        let x = left + plate[0] + BAR;
        if self.categories.is_empty() {
            // The label is above the bar.
            let room = plate[1] - 40;
            let height = room.min(420);
            let y = top + 40 + (room - height) / 2;
            let (label, map) = (self.scalar.label, self.scalar.map);
            draw_bar(&mut canvas, [x, y], [18, height], label, map, self.scalar.scale());
        } else {
            let bottom = size[1] - 8;
            draw_categories(&mut canvas, [x, top + 24], bottom, self.scalar.label, self.categories);
        }
        Ok(canvas.into_picture())
    }

    /// The axes, if there is room for them.
    fn axes(&self) -> Option<Axes<'a>> {
        let least = [LEFT_OF_AXES + LEAST_WITH_AXES + RIGHT, TOP_OF_AXES + 100 + BOTTOM];
        let has_room = |size: [usize; 2]| size[0] >= least[0] && size[1] >= least[1];
        self.axes.filter(|_| self.size.is_none_or(has_room))
    }

    /// The pixels to the left of the drawing and above it.
    fn margins(&self) -> [usize; 2] {
        if self.axes().is_some() { [LEFT_OF_AXES, TOP_OF_AXES] } else { [LEFT, TOP] }
    }

    /// The room for the drawing and the size of the drawing, in pixels across and down.
    fn plate_and_drawing(&self) -> Result<[[usize; 2]; 2], PictureError> {
        let Some(size) = self.size else {
            check_size([self.pixels; 2])?;
            let drawing = fitted_layer(self.lattice, [self.columns, self.rows], [self.pixels; 2]);
            // A narrow drawing leaves room for the title, a flat one for the bar.
            return Ok([[drawing[0].max(320), drawing[1].max(240)], drawing]);
        };
        let [left, top] = self.margins();
        let plate = [size[0].saturating_sub(left + RIGHT), size[1].saturating_sub(top + BOTTOM)];
        if plate.iter().any(|room| *room < 100) {
            return Err(PictureError::Size { size });
        }
        Ok([plate, fitted_layer(self.lattice, [self.columns, self.rows], plate)])
    }

    fn draw_cells(&self, canvas: &mut Canvas, [x0, y0]: [usize; 2], size: [usize; 2]) {
        let kinds: Vec<f64> = self.categories.iter().map(|category| category.value).collect();
        let palette = Palette::coloured(self.scalar.map, self.categories);
        let cells = [self.columns, self.rows];
        let ground = self.relief.map(|relief| Ground::new(relief, cells, self.cell_side));
        let mosaic = Mosaic::new(cells, self.scalar.values, &kinds, self.scalar.scale(), &palette);
        mosaic
            .on(self.lattice)
            .over(ground.as_ref())
            .without(self.hidden)
            .draw(size, |x, y, colour| canvas.set(x0 + x, y0 + y, encode(colour)));
    }

    /// Draws a bar of a round length below the drawing. `[x, y]` is the lower left corner of the drawing,
    /// `width` its width in pixels and `length` its length in `length_unit`.
    fn draw_scale(&self, canvas: &mut Canvas, [x, y]: [usize; 2], width: usize, length: f64) {
        if !(length.is_finite() && length > 0.0) {
            return;
        }
        let power = 10.0_f64.powf((length / 3.0).log10().floor());
        let round =
            [5.0, 2.0, 1.0].into_iter().map(|f| f * power).find(|r| *r <= length / 3.0).unwrap_or(power);
        let pixels = (round / length * width as f64) as f32;
        let (left, line) = (x as f32, y as f32 + 20.5);
        let right = left + pixels;
        let end = |x: f32| [[x, line - 4.0], [x, line + 4.0]];
        let segments = vec![[[left, line], [right, line]], end(left), end(right)];
        canvas.stroke(&Strokes { segments, width: 1.4 }, INK);
        let text = format!("{} {}", significant(round, 4), self.length_unit);
        let style = Style { height: 11.0, colour: FAINT_INK };
        text::draw(canvas, &text, [right + 12.0, line + 5.5], Anchor::Left, &style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ColourMap;
    use crate::mosaic::GREY;

    fn colour(t: f64) -> [u8; 3] {
        encode(ColourMap::Sequential.linear(t)).map(|x| (x * 255.0).round() as u8)
    }

    fn near(a: [u8; 3], b: [u8; 3]) -> bool {
        (0..3).all(|i| a[i].abs_diff(b[i]) <= 2)
    }

    #[test]
    fn small_cells_are_squares_with_the_first_row_below() {
        let values = [0.0, 1.0, 0.25, 0.5, 0.75, 1.0];
        let mut slice = SlicePicture::new(3, 2, Scalar::new("t", &values));
        slice.pixels = 600;
        let picture = slice.render().unwrap();
        assert_eq!((picture.width(), picture.height()), (LEFT + 600 + RIGHT, TOP + 400 + BOTTOM));
        for (i, value) in values.into_iter().enumerate() {
            let (x, y) = (LEFT + 200 * (i % 3), TOP + 200 * (1 - i / 3));
            for (dx, dy) in [(0, 0), (199, 0), (0, 199), (199, 199)] {
                assert!(near(picture.pixel(x + dx, y + dy), colour(value)), "cell {i} at {dx} {dy}");
            }
        }
    }

    #[test]
    fn many_cells_are_averaged_by_their_areas() {
        // Columns of 0 and 1 alternate: every pixel shows the mean, one half.
        let values: Vec<f64> = (0..800 * 400).map(|i| f64::from(i % 2)).collect();
        let mut slice = SlicePicture::new(800, 400, Scalar::new("t", &values));
        slice.pixels = 400;
        let picture = slice.render().unwrap();
        assert_eq!(picture.height(), TOP + 240 + BOTTOM);
        for (x, y) in [(0, 0), (200, 100), (399, 199)] {
            let found = picture.pixel(LEFT + x, TOP + 20 + y);
            assert!(near(found, colour(0.5)), "{found:?} at {x} {y}, not {:?}", colour(0.5));
        }
    }

    #[test]
    fn a_cell_that_two_pixels_share_counts_by_halves() {
        // Three cells on two pixels: the first shows (0 + 0 / 2) / 1.5, the second (0 / 2 + 1) / 1.5.
        let values: Vec<f64> = (0..300).map(|i| f64::from(i % 3 / 2)).collect();
        let mut slice = SlicePicture::new(300, 1, Scalar::new("t", &values));
        slice.pixels = 200;
        let picture = slice.render().unwrap();
        let at = |x: usize| picture.pixel(LEFT + 60 + x, TOP + 119);
        assert!(
            near(at(100), colour(0.0)) && near(at(101), colour(2.0 / 3.0)),
            "{:?} {:?}",
            at(100),
            at(101)
        );
    }

    #[test]
    fn kinds_have_colours_of_their_own_and_others_are_grey() {
        let mut slice = SlicePicture::new(3, 1, Scalar::new("state", &[0.0, 1.0, 7.0]));
        let categories = [Category::new(0, 0.0, "dead"), Category::new(1, 1.0, "alive")];
        slice.categories = &categories;
        slice.pixels = 300;
        let picture = slice.render().unwrap();
        let at = |cell: usize| picture.pixel(LEFT + 10 + 100 * cell + 50, TOP + 70 + 50);
        let bytes = |linear| encode(linear).map(|x| (x * 255.0).round() as u8);
        assert_eq!([at(0), at(1), at(2)], [categories[0].colour, categories[1].colour, bytes(GREY)]);
    }

    #[test]
    fn hidden_cells_show_the_background_and_do_not_count() {
        let hidden = [false, true, false];
        let mut slice = SlicePicture::new(3, 1, Scalar::new("t", &[0.0, f64::NAN, 1.0]));
        slice.hidden = Some(&hidden);
        slice.pixels = 300;
        let picture = slice.render().unwrap();
        let at = |cell: usize| picture.pixel(LEFT + 10 + 100 * cell + 50, TOP + 70 + 50);
        assert_eq!(at(1), [255; 3]);
        assert!(near(at(0), colour(0.0)) && near(at(2), colour(1.0)));
        // In a pixel with three cells, the hidden cell does not count. If all cells are hidden, the
        // background shows.
        let values: Vec<f64> = (0..1200).map(|i| [0.0, 1.0, 1e9][i % 3]).collect();
        let hidden: Vec<bool> = (0..1200).map(|i| i % 3 == 2 || i >= 600).collect();
        let mut scalar = Scalar::new("t", &values);
        scalar.range = Some([0.0, 1.0]);
        let mut slice = SlicePicture::new(1200, 1, scalar);
        slice.hidden = Some(&hidden);
        slice.pixels = 400;
        let picture = slice.render().unwrap();
        let at = |x: usize| picture.pixel(LEFT + x, TOP + 119);
        assert!(near(at(100), colour(0.5)), "{:?}", at(100));
        assert_eq!(at(300), [255; 3]);
    }

    #[test]
    fn a_picture_has_the_size_that_is_wanted() {
        for (columns, rows) in [(3, 2), (2, 300), (4000, 3)] {
            let values = vec![0.5; columns * rows];
            let slice = SlicePicture::new(columns, rows, Scalar::new("t", &values));
            let picture = SlicePicture { size: Some([500, 333]), ..slice }.render().unwrap();
            assert_eq!((picture.width(), picture.height()), (500, 333));
        }
        let slice = SlicePicture::new(1, 1, Scalar::new("t", &[0.0]));
        assert!(SlicePicture { size: Some([300, 300]), ..slice }.render().is_err());
    }

    /// The columns or rows of ticks: dark pixels halfway along their length outside the frame.
    fn ticks(picture: &Picture, along: impl Fn(usize) -> [usize; 2], count: usize) -> Vec<usize> {
        let is_dark = |at: &usize| {
            let [x, y] = along(*at);
            picture.pixel(x, y)[0] < 100
        };
        (0..count).filter(is_dark).collect()
    }

    /// Cells of 10 m with 40 pixels each from 4,251,190 to the east and -25 to the north.
    #[test]
    fn a_tick_is_at_the_pixel_of_its_coordinate() {
        let values: Vec<f64> = (0..15 * 10).map(f64::from).collect();
        let mut slice = SlicePicture::new(15, 10, Scalar::new("t", &values));
        (slice.pixels, slice.cell_side) = (600, 10.0);
        slice.axes = Some(Axes { names: ["easting (m)", "northing (m)"], corner: [4_251_190.0, -25.0] });
        let picture = slice.render().unwrap();
        assert_eq!(
            (picture.width(), picture.height()),
            (LEFT_OF_AXES + 600 + RIGHT, TOP_OF_AXES + 400 + BOTTOM)
        );
        // The drawing itself is in the same place.
        assert!(near(picture.pixel(LEFT_OF_AXES, TOP_OF_AXES + 399), colour(0.0)));
        let below = ticks(&picture, |x| [x, TOP_OF_AXES + 404], LEFT_OF_AXES + 600);
        // 4,251,200 is 10 m or 40 pixels from the corner. The next tick is 20 m farther. The last tick is the
        // right end.
        let mut wanted: Vec<usize> = (0..8).map(|i| LEFT_OF_AXES + 40 + 80 * i).collect();
        wanted[7] -= 1;
        assert_eq!(below, wanted);
        // -20 is 5 m above the corner: 20 pixels, counted from below. The next tick is 0.
        let beside = ticks(&picture, |y| [LEFT_OF_AXES - 5, y], picture.height());
        let mut wanted: Vec<usize> = (0..5).map(|i| TOP_OF_AXES + 399 - 20 - 80 * i).collect();
        wanted.reverse();
        assert_eq!(beside, wanted);
    }

    /// For any coordinates, there are enough labels, no two labels touch, and none is clipped.
    #[test]
    fn labels_do_not_overlap() {
        for (corner, side) in [([4_251_003.0, 651_234.0], 2.0), ([-9.5e6, 0.25], 0.125), ([0.0, 0.0], 3e4)] {
            for columns in [40, 96, 384] {
                let values = vec![0.0; columns * 96];
                let mut slice = SlicePicture::new(columns, 96, Scalar::new("t", &values));
                slice.cell_side = side;
                slice.axes = Some(Axes { names: ["", ""], corner });
                let picture = slice.render().unwrap();
                let drawing = fitted_layer(Lattice::Squares, [columns, 96], [768; 2]);
                let plate = [drawing[0].max(320), drawing[1].max(240)];
                let bottom = TOP_OF_AXES + (plate[1] - drawing[1]) / 2 + drawing[1];
                let count = ticks(&picture, |x| [x, bottom + 4], picture.width()).len();
                // Ink in the rows of the labels. A label ends where some pixels have no ink.
                let has_ink = |x: usize| (bottom + 9..bottom + 22).any(|y| picture.pixel(x, y)[0] < 200);
                let inked: Vec<usize> = (0..picture.width()).filter(|x| has_ink(*x)).collect();
                let labels = 1 + inked.windows(2).filter(|pair| pair[1] - pair[0] > 8).count();
                let what = format!("{corner:?} {columns}: {labels} labels of {count} ticks");
                assert!(count >= 2 && labels <= count && labels + 1 >= count, "{what}");
                assert!(inked[0] > 3 && inked[inked.len() - 1] < picture.width() - RIGHT + BAR, "{what}");
                // The labels beside the frame begin inside the picture.
                let is_white = |y: usize| (0..6).all(|x| picture.pixel(x, y) == [255; 3]);
                assert!((TOP_OF_AXES..bottom).all(is_white), "{what}");
            }
        }
    }

    #[test]
    fn a_picture_without_room_for_axes_has_the_scale() {
        let values = vec![0.5; 6];
        let slice = SlicePicture::new(3, 2, Scalar::new("t", &values));
        let axes = Some(Axes { names: ["x (m)", "y (m)"], corner: [0.0; 2] });
        let drawn = |size: [usize; 2], axes| {
            SlicePicture { size: Some(size), axes, ..slice.clone() }.render().unwrap()
        };
        assert_eq!(drawn([400, 300], axes), drawn([400, 300], None));
        let (with, without) = (drawn([500, 300], axes), drawn([500, 300], None));
        assert!(with != without && (with.width(), with.height()) == (500, 300));
        // NaN coordinates have no ticks.
        let nowhere = Some(Axes { names: ["", ""], corner: [f64::NAN, 0.0] });
        drawn([500, 300], nowhere);
    }

    #[test]
    fn what_cannot_be_drawn_is_said() {
        let error = |columns, rows, n: usize| {
            let values = vec![0.0; n];
            SlicePicture::new(columns, rows, Scalar::new("t", &values)).render().unwrap_err().to_string()
        };
        assert_eq!(error(3, 2, 5), "cannot draw `t`: 5 values for 6 cells");
        assert_eq!(error(0, 2, 0), "cannot draw a slice of 0 by 2 cells");
        assert!(error(usize::MAX, 2, 0).contains("0 values"));
        let relief = Some(Relief { heights: &[0.0; 5], bare: 0.0 });
        let picture = SlicePicture { relief, ..SlicePicture::new(3, 2, Scalar::new("t", &[0.0; 6])) };
        let error = picture.render().unwrap_err().to_string();
        assert_eq!(error, "cannot draw `heights`: 5 values for 6 cells");
        assert!(
            SlicePicture { pixels: 9000, ..SlicePicture::new(1, 1, Scalar::new("t", &[f64::NAN])) }
                .render()
                .is_err()
        );
    }
}
