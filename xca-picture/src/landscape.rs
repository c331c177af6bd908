//! Pictures of a layer of cells over the relief of the ground, in three dimensions.

use super::block::{BRIGHTNESS, SAMPLES};
use super::canvas::Canvas;
use super::category::Category;
use super::colour::encode;
use super::eye::Eye;
use super::legend::{Scalar, draw_bar, draw_categories, draw_title};
use super::mosaic::Palette;
use super::relief::{Ground, Relief};
use super::{Picture, PictureError, check_size};
use xca_io::numbers::significant;

/// The thickness of the ground below its lowest point, and the apparent height of the relief, as shares of
/// the longer side.
const BASE: f64 = 0.03;
const HEIGHT: f64 = 0.2;

/// One layer of a dense substate as columns as high as the ground. The view is from above and the front
/// without perspective.
///
/// Heights are exaggerated to show the relief. The caption states the factor.
#[derive(Debug, Clone)]
pub struct LandscapePicture<'a> {
    /// The number of cells along x and y.
    pub cells: [usize; 2],
    /// The side of a cell, in the unit of the heights.
    pub cell_side: f64,
    /// The values, x fastest, the lowest y first.
    pub scalar: Scalar<'a>,
    /// The categories of the values, if not empty. Other values are drawn in grey.
    pub categories: &'a [Category],
    /// The heights of the columns.
    pub relief: Relief<'a>,
    /// The cells that are not drawn, in the order of the values.
    pub hidden: Option<&'a [bool]>,
    /// The text above the picture.
    pub title: &'a str,
    /// The smaller text below the title.
    pub caption: &'a str,
    /// Width and height in pixels, from 200 to 8192 each.
    pub size: [usize; 2],
}

/// The least step between columns that is drawn as a wall, in sides of a cell.
const STEP: f64 = 2.0;

/// The columns, in sides of a cell.
struct Columns {
    /// NaN without ground.
    heights: Vec<f64>,
    highest: f64,
    /// The factor of exaggeration.
    factor: f64,
}

/// The first hit of a line of sight: the top of a column, or a side of it along an axis.
struct Hit {
    cell: usize,
    side: Option<usize>,
}

impl<'a> LandscapePicture<'a> {
    /// A picture of 800 by 600 pixels without text.
    #[must_use]
    pub fn new(cells: [usize; 2], cell_side: f64, scalar: Scalar<'a>, relief: Relief<'a>) -> Self {
        let (categories, hidden, title, caption, size) = (&[][..], None, "", "", [800, 600]);
        Self { cells, cell_side, scalar, categories, relief, hidden, title, caption, size }
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// [`PictureError::NoCells`], [`PictureError::Length`] (one value and one height for each cell) and
    /// [`PictureError::Size`].
    pub fn render(&self) -> Result<Picture, PictureError> {
        let [columns, rows] = self.cells;
        if self.cells.contains(&0) {
            return Err(PictureError::NoCells { columns, rows });
        }
        let cells = columns.saturating_mul(rows);
        self.scalar.check(cells, "cells")?;
        Scalar::new("heights", self.relief.heights).check(cells, "cells")?;
        check_size(self.size)?;
        let [width, height] = self.size;
        let mut canvas = Canvas::new(width, height, [1.0; 3]);
        let found = self.columns();
        self.draw_columns(&mut canvas, &found);
        let factor = format!("heights x {}", significant(found.factor, 2));
        let caption = [self.caption, &factor].into_iter().filter(|text| !text.is_empty());
        draw_title(&mut canvas, 36.0, self.title, &caption.collect::<Vec<_>>().join(", "));
        let x = width - 128;
        if self.categories.is_empty() {
            let (y, h) = (height * 3 / 10, height * 9 / 20);
            let Scalar { label, map, .. } = self.scalar;
            draw_bar(&mut canvas, [x, y], [18, h], label, map, self.scalar.scale());
        } else {
            draw_categories(&mut canvas, [x, 120], height - 8, self.scalar.label, self.categories);
        }
        Ok(canvas.into_picture())
    }

    fn is_hidden(&self, cell: usize) -> bool {
        self.hidden.is_some_and(|hidden| hidden.get(cell) == Some(&true))
    }

    fn columns(&self) -> Columns {
        let heights = self.relief.heights.iter().enumerate();
        let heights: Vec<f64> = heights
            .map(|(cell, height)| {
                let is_drawn = height.is_finite() && !self.is_hidden(cell);
                if is_drawn { height / self.cell_side } else { f64::NAN }
            })
            .collect();
        let least = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let most = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let longest = self.cells.into_iter().max().unwrap_or(1) as f64;
        let factor = if most > least { (HEIGHT * longest / (most - least)).max(1.0) } else { 1.0 };
        let base = BASE * longest;
        let above = |height: &f64| base + (height - least) * factor;
        let highest = if most >= least { above(&most) } else { base };
        Columns { heights: heights.iter().map(above).collect(), highest, factor }
    }

    fn draw_columns(&self, canvas: &mut Canvas, columns: &Columns) {
        const SHARE: f32 = 1.0 / (SAMPLES * SAMPLES) as f32;
        let palette = Palette::coloured(self.scalar.map, self.categories);
        let scale = self.scalar.scale();
        let ground = Ground::new(self.relief, self.cells, self.cell_side);
        let colour = |hit: &Hit| {
            let value = self.scalar.values[hit.cell];
            let own = if self.categories.is_empty() {
                palette.of(scale.place(value))
            } else {
                palette.kind(Category::number_of(self.categories, value))
            };
            let top = ground.colour(hit.cell, value, own);
            let light = hit.side.map_or(1.0, |axis| BRIGHTNESS[axis]);
            top.map(|lane| lane * light)
        };
        let [width, height] = [canvas.width() as f64, canvas.height() as f64];
        let extents = [self.cells[0] as f64, self.cells[1] as f64, columns.highest];
        let eye = Eye::new(extents, [40.0, 92.0], [width - 176.0, height - 40.0]);
        let at = |pixel: usize, sample: usize| pixel as f64 + (sample as f64 + 0.5) / SAMPLES as f64;
        for y in 0..canvas.height() {
            for x in 0..canvas.width() {
                let (mut sum, mut cover) = ([0.0_f32; 3], 0.0);
                for sample in 0..SAMPLES * SAMPLES {
                    let point = eye.point(at(x, sample % SAMPLES), at(y, sample / SAMPLES));
                    let from = std::array::from_fn(|i| point[i] + extents[i] / 2.0);
                    if let Some(hit) = self.hit(columns, extents, from, eye.forward) {
                        let colour = colour(&hit);
                        sum = std::array::from_fn(|i| sum[i] + colour[i] * SHARE);
                        cover += SHARE;
                    }
                }
                if cover > 0.0 {
                    canvas.blend(x, y, encode(sum.map(|lane| (lane / cover).min(1.0))), cover);
                }
            }
        }
    }

    /// The first column on a line of sight that runs downwards: walks from column to column.
    fn hit(&self, columns: &Columns, extents: [f64; 3], from: [f64; 3], towards: [f64; 3]) -> Option<Hit> {
        let (mut enter, mut leave, mut axis) = (f64::NEG_INFINITY, f64::INFINITY, 2);
        for i in 0..3 {
            let ends = [-from[i] / towards[i], (extents[i] - from[i]) / towards[i]];
            let [near, far] = if towards[i] > 0.0 { ends } else { [ends[1], ends[0]] };
            if near > enter {
                (enter, axis) = (near, i);
            }
            leave = leave.min(far);
        }
        if enter >= leave {
            return None;
        }
        let mut cell: [usize; 2] = std::array::from_fn(|i| {
            let at = (from[i] + enter * towards[i]).clamp(0.0, extents[i]);
            (at as usize).min(self.cells[i] - 1)
        });
        let (mut t, mut before) = (enter, f64::NEG_INFINITY);
        loop {
            let face = |i: usize| cell[i] as f64 + if towards[i] > 0.0 { 1.0 } else { 0.0 };
            let crossing = |i: usize| (face(i) - from[i]) / towards[i];
            let next = if crossing(0) < crossing(1) { 0 } else { 1 };
            let number = cell[1] * self.cells[0] + cell[0];
            let top = columns.heights[number];
            let at = |t: f64| from[2] + t * towards[2];
            if at(t) <= top {
                // Low steps are a slope, lit like the top.
                let is_step = before.is_nan() || top - before > STEP;
                return Some(Hit { cell: number, side: (axis < 2 && is_step).then_some(axis) });
            }
            let end = crossing(next).min(leave);
            if at(end) <= top {
                return Some(Hit { cell: number, side: None });
            }
            if crossing(next) >= leave {
                return None;
            }
            (t, axis, before) = (crossing(next), next, top);
            cell[next] = if towards[next] > 0.0 { cell[next] + 1 } else { cell[next].checked_sub(1)? };
            if cell[next] >= self.cells[next] {
                return None;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(heights: &[f64], cells: [usize; 2]) -> Picture {
        let values: Vec<f64> = (0..heights.len()).map(|cell| cell as f64).collect();
        let relief = Relief { heights, bare: -1.0 };
        LandscapePicture::new(cells, 10.0, Scalar::new("t", &values), relief).render().unwrap()
    }

    /// The heights of the columns in the picture: the top of each on the vertical line through its middle.
    #[test]
    fn columns_are_as_high_as_the_ground() {
        // A tower in the middle of a plain.
        let mut heights = vec![100.0; 81];
        heights[40] = 160.0;
        let picture_of = LandscapePicture::new(
            [9, 9],
            10.0,
            Scalar::new("t", &[0.0; 81]),
            Relief { heights: &heights, bare: -1.0 },
        );
        let columns = picture_of.columns();
        // 60 m are 6 sides of a cell. This is more than a fifth of 9 cells, so heights are not exaggerated.
        assert_eq!((columns.factor, columns.heights[40] - columns.heights[0]), (1.0, 6.0));
        let extents = [9.0, 9.0, columns.highest];
        let eye = Eye::new(extents, [40.0, 92.0], [800.0 - 176.0, 560.0]);
        for (cell, side) in [([4, 4], None), ([0, 0], None), ([8, 0], None), ([8, 4], None)] {
            let number = cell[1] * 9 + cell[0];
            let top = [cell[0] as f64 + 0.5, cell[1] as f64 + 0.5, columns.heights[number]];
            let [x, y] = eye.project(std::array::from_fn(|i| top[i] - extents[i] / 2.0));
            let point = eye.point(x, y);
            let from = std::array::from_fn(|i| point[i] + extents[i] / 2.0);
            let hit = picture_of.hit(&columns, extents, from, eye.forward).unwrap();
            assert_eq!((hit.cell, hit.side), (number, side), "{cell:?}");
        }
        // The picture shows the side of the tower in place of the plain behind it, in the north-west.
        let hidden = [2.5, 6.5, columns.heights[0]];
        let [x, y] = eye.project(std::array::from_fn(|i| hidden[i] - extents[i] / 2.0));
        let point = eye.point(x, y);
        let from = std::array::from_fn(|i| point[i] + extents[i] / 2.0);
        let hit = picture_of.hit(&columns, extents, from, eye.forward).unwrap();
        assert_eq!(hit.cell, 40);
    }

    #[test]
    fn gentle_relief_is_made_higher_and_nothing_stands_where_there_is_no_ground() {
        let heights: Vec<f64> = (0..100).map(|cell| f64::from(cell % 10) * 0.1).collect();
        let values = [0.0; 100];
        let relief = Relief { heights: &heights, bare: -1.0 };
        let hidden: Vec<bool> = (0..100).map(|cell| cell >= 50).collect();
        let mut drawn = LandscapePicture::new([10, 10], 10.0, Scalar::new("t", &values), relief);
        // 0.9 m are 0.09 sides of a cell, and are drawn as 2.
        assert!((drawn.columns().factor - 2.0 / 0.09).abs() < 1e-9);
        let whole = drawn.render().unwrap();
        drawn.hidden = Some(&hidden);
        assert!(drawn.columns().heights[50..].iter().all(|height| height.is_nan()));
        let white = |picture: &Picture| {
            let all = (0..600).flat_map(|y| (0..600).map(move |x| (x, y)));
            all.filter(|(x, y)| picture.pixel(*x, *y) == [255; 3]).count()
        };
        assert!(white(&drawn.render().unwrap()) > white(&whole) + 40_000);
    }

    #[test]
    fn what_cannot_be_drawn_is_said() {
        let relief = Relief { heights: &[0.0; 5], bare: 0.0 };
        let error = LandscapePicture::new([3, 2], 1.0, Scalar::new("t", &[0.0; 6]), relief).render();
        assert_eq!(error.unwrap_err().to_string(), "cannot draw `heights`: 5 values for 6 cells");
        // No cell has a height, or all have the same.
        picture(&[f64::NAN; 4], [2, 2]);
        picture(&[7.0; 4], [2, 2]);
    }
}
