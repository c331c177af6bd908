//! Pictures of dense substates in three dimensions.

use super::canvas::{Canvas, Strokes};
use super::category::Category;
use super::colour::{encode, mix};
use super::eye::Eye;
use super::legend::{INK, Scalar, draw_bar, draw_categories, draw_title};
use super::mosaic::GREY;
use super::{Picture, PictureError, check_size};

/// Samples per pixel in each direction.
pub(super) const SAMPLES: usize = 2;
/// The brightness of the faces that face along x, y and z.
pub(super) const BRIGHTNESS: [f32; 3] = [0.60, 0.80, 1.0];
/// The share of white in the faces of separate cubes.
const LIT: [f32; 3] = [0.0, 0.06, 0.22];

/// All cells of a dense substate as small cubes. The view is from above and the front without perspective, z
/// up.
#[derive(Debug, Clone)]
pub struct BlockPicture<'a> {
    /// The number of cells along x, y and z.
    pub extents: [usize; 3],
    /// The values, x fastest, then y.
    pub scalar: Scalar<'a>,
    /// The categories of the values, if not empty. Other values are drawn in grey.
    pub categories: &'a [Category],
    /// Cells of this value are not drawn. If it is `None`, all cells are drawn except for the octant next to
    /// the viewer. The inside is then visible.
    pub empty: Option<f64>,
    /// The cells that are not drawn, in the order of the values.
    pub hidden: Option<&'a [bool]>,
    /// The text above the picture.
    pub title: &'a str,
    /// The smaller text below the title.
    pub caption: &'a str,
    /// Width and height in pixels, from 200 to 8192 each.
    pub size: [usize; 2],
}

impl<'a> BlockPicture<'a> {
    /// A picture of 800 by 600 pixels without text.
    #[must_use]
    pub fn new(extents: [usize; 3], scalar: Scalar<'a>) -> Self {
        Self {
            extents,
            scalar,
            categories: &[],
            empty: None,
            hidden: None,
            title: "",
            caption: "",
            size: [800, 600],
        }
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// [`PictureError::NoCells`], [`PictureError::Length`] (one value for each cell) and
    /// [`PictureError::Size`].
    pub fn render(&self) -> Result<Picture, PictureError> {
        let [columns, rows, layers] = self.extents;
        if self.extents.contains(&0) {
            return Err(PictureError::NoCells { columns, rows });
        }
        self.scalar.check(columns.saturating_mul(rows).saturating_mul(layers), "cells")?;
        check_size(self.size)?;
        let [width, height] = self.size;
        let mut canvas = Canvas::new(width, height, [1.0; 3]);
        let extents = self.extents.map(|extent| extent as f64);
        let eye = Eye::new(extents, [40.0, 92.0], [width as f64 - 176.0, height as f64 - 40.0]);
        self.draw_edges(&mut canvas, &eye, false);
        self.draw_cells(&mut canvas, &eye);
        self.draw_edges(&mut canvas, &eye, true);
        draw_title(&mut canvas, 36.0, self.title, self.caption);
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

    fn draw_cells(&self, canvas: &mut Canvas, eye: &Eye) {
        const SHARE: f32 = 1.0 / (SAMPLES * SAMPLES) as f32;
        let (table, scale) = (self.scalar.map.table(), self.scalar.scale());
        let colours: Vec<[f32; 3]> = self.categories.iter().map(Category::linear).collect();
        let colour_of = |value: f64| {
            if self.categories.is_empty() {
                scale.place(value).map_or(GREY, |place| table[(place * 255.0).round() as usize])
            } else {
                Category::number_of(self.categories, value).map_or(GREY, |number| colours[number])
            }
        };
        let at = |pixel: usize, sample: usize| pixel as f64 + (sample as f64 + 0.5) / SAMPLES as f64;
        for y in 0..canvas.height() {
            for x in 0..canvas.width() {
                let (mut sum, mut cover) = ([0.0_f32; 3], 0.0);
                for sample in 0..SAMPLES * SAMPLES {
                    let point = eye.point(at(x, sample % SAMPLES), at(y, sample / SAMPLES));
                    if let Some(Hit { value, axis, depth }) = self.hit(eye, point) {
                        // Distance tells separate cubes apart.
                        let haze = if self.empty.is_some() { 1.12 - 0.45 * depth } else { 1.0 };
                        let light = BRIGHTNESS[axis] * haze;
                        // Separate cubes may be dark, so light also adds white.
                        let lit = if self.empty.is_some() { LIT[axis] } else { 0.0 };
                        let colour = mix(colour_of(value), [1.0; 3], lit);
                        sum = std::array::from_fn(|i| sum[i] + colour[i] * light * SHARE);
                        cover += SHARE;
                    }
                }
                if cover > 0.0 {
                    canvas.blend(x, y, encode(sum.map(|c| (c / cover).min(1.0))), cover);
                }
            }
        }
    }

    /// The first visible cell at a point: walks from cell to cell away from the viewer.
    fn hit(&self, eye: &Eye, point: [f64; 3]) -> Option<Hit> {
        let extents = self.extents.map(|extent| extent as f64);
        let towards = eye.forward;
        // The point, relative to the lower corner of the block. Then where its line of sight enters and
        // leaves the block.
        let from: [f64; 3] = std::array::from_fn(|i| point[i] + extents[i] / 2.0);
        let (mut enter, mut leave, mut axis) = (f64::NEG_INFINITY, f64::INFINITY, 0);
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
        let mut cell: [usize; 3] = std::array::from_fn(|i| {
            let at = (from[i] + enter * towards[i]).clamp(0.0, extents[i]);
            (at as usize).min(self.extents[i] - 1)
        });
        let mut t = enter;
        let length = extents.iter().map(|extent| extent * extent).sum::<f64>().sqrt();
        loop {
            if let Some(value) = self.solid(cell) {
                let depth = ((t / length) + 0.5).clamp(0.0, 1.0) as f32;
                return Some(Hit { value, axis, depth });
            }
            // The next face on the line of sight.
            let face = |i: usize| cell[i] as f64 + if towards[i] > 0.0 { 1.0 } else { 0.0 };
            let crossing = |i: usize| (face(i) - from[i]) / towards[i];
            axis = (0..3).min_by(|&a, &b| crossing(a).total_cmp(&crossing(b)))?;
            t = crossing(axis);
            cell[axis] = if towards[axis] > 0.0 { cell[axis] + 1 } else { cell[axis].checked_sub(1)? };
            if cell[axis] >= self.extents[axis] {
                return None;
            }
        }
    }

    /// The value of a cell, if it is drawn.
    fn solid(&self, [x, y, z]: [usize; 3]) -> Option<f64> {
        let [columns, rows, _] = self.extents;
        let cell = (z * rows + y) * columns + x;
        if self.hidden.is_some_and(|hidden| hidden.get(cell) == Some(&true)) {
            return None;
        }
        let value = self.scalar.values[cell];
        match self.empty {
            Some(empty) => (value != empty).then_some(value),
            None => {
                let octant = self.cut().is_some_and(|cut| x >= cut[0] && y < cut[1] && z >= cut[2]);
                (!octant).then_some(value)
            }
        }
    }

    /// The corner of the octant that is cut out, in the middle of the block. `None` if there is no cut.
    fn cut(&self) -> Option<[usize; 3]> {
        let [columns, rows, layers] = self.extents;
        let has_inside = self.empty.is_none() && self.extents.iter().all(|extent| *extent > 1);
        has_inside.then(|| [columns.div_ceil(2), rows / 2, layers.div_ceil(2)])
    }

    /// Draws the edges of the block, either those in front of it or those behind. If an octant is cut out,
    /// its edges replace the missing ones.
    fn draw_edges(&self, canvas: &mut Canvas, eye: &Eye, in_front: bool) {
        let half = self.extents.map(|extent| extent as f64 / 2.0);
        // The corner farthest from the viewer has the three hidden edges.
        let far: usize = (0..3).filter(|&i| eye.forward[i] > 0.0).map(|i| 1 << i).sum();
        let near = 7 - far;
        let cut = self.cut().map(|cut| -> [f64; 3] { std::array::from_fn(|i| cut[i] as f64 - half[i]) });
        let of_block =
            |index: usize| std::array::from_fn(|i| if index >> i & 1 == 1 { half[i] } else { -half[i] });
        let mut strokes = Strokes { segments: Vec::new(), width: if in_front { 1.2 } else { 1.0 } };
        let mut draw = |ends: [[f64; 3]; 2]| {
            strokes.segments.push(ends.map(|end| eye.project(end).map(|x| x as f32)));
        };
        for axis in 0..3 {
            for start in (0..8_usize).filter(|start| start >> axis & 1 == 0) {
                let ends = [start, start | 1 << axis];
                let is_near = ends.contains(&near);
                if ends.contains(&far) == in_front {
                    continue;
                }
                draw(ends.map(|end| {
                    let mut corner: [f64; 3] = of_block(end);
                    if let Some(cut) = cut.filter(|_| is_near && end == near) {
                        corner[axis] = cut[axis];
                    }
                    corner
                }));
            }
            // The nine edges of the octant that do not meet in the missing corner.
            let octants = cut.filter(|_| in_front).map(|cut| (cut, of_block(near)));
            for start in (0..8_usize).filter(|start| start >> axis & 1 == 0) {
                let ends = [start, start | 1 << axis];
                if let Some((cut, near)) = octants.filter(|_| !ends.contains(&7)) {
                    draw(ends.map(|end| {
                        std::array::from_fn(|i| if end >> i & 1 == 1 { near[i] } else { cut[i] })
                    }));
                }
            }
        }
        let colour = if in_front { INK } else { [0.72, 0.74, 0.78] };
        let strength = match (in_front, self.empty) {
            (false, _) => 1.0,
            (true, None) => 0.55,
            // These edges lie in front of cubes and must not divide them.
            (true, Some(_)) => 0.3,
        };
        strokes.cover(canvas.width(), canvas.height(), |x, y, cover| {
            canvas.blend(x, y, colour, cover * strength);
        });
    }
}

/// The first cell on a line of sight.
struct Hit {
    value: f64,
    /// The axis along which the visible face faces.
    axis: usize,
    /// The depth from 0 (nearest) to 1.
    depth: f32,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ColourMap;

    fn eye(extents: [usize; 3]) -> Eye {
        Eye::new(extents.map(|n| n as f64), [40.0, 92.0], [800.0 - 176.0, 560.0])
    }

    /// The colour in the middle of the visible face of a cell along `axis`.
    fn at_face(picture: &Picture, extents: [usize; 3], cell: [usize; 3], axis: usize) -> [u8; 3] {
        let towards_eye = [1.0, 0.0, 1.0];
        let point = std::array::from_fn(|i| {
            let within = if i == axis { towards_eye[i] } else { 0.5 };
            cell[i] as f64 + within - extents[i] as f64 / 2.0
        });
        let [x, y] = eye(extents).project(point);
        picture.pixel(x as usize, y as usize)
    }

    fn colour(place: f64, axis: usize) -> [u8; 3] {
        let linear = ColourMap::Sequential.linear(place).map(|c| c * BRIGHTNESS[axis]);
        encode(linear).map(|c| (c * 255.0).round() as u8)
    }

    fn near(a: [u8; 3], b: [u8; 3]) -> bool {
        (0..3).all(|i| a[i].abs_diff(b[i]) <= 2)
    }

    #[test]
    fn faces_have_the_colours_of_their_cells_and_an_octant_is_cut_out() {
        let extents = [4, 6, 2];
        let values: Vec<f64> = (0..48).map(f64::from).collect();
        let picture = BlockPicture::new(extents, Scalar::new("t", &values)).render().unwrap();
        // Upper faces, and faces towards x and y. Some are outer faces, others those of the cut below z = 1,
        // at y = 3 and at x = 2.
        for (cell, axis) in [
            ([0, 0, 1], 2),
            ([1, 5, 1], 2),
            ([3, 4, 1], 2),
            ([3, 1, 0], 2),
            ([0, 0, 0], 1),
            ([3, 0, 0], 1),
            ([2, 3, 1], 1),
            ([3, 5, 0], 0),
            ([3, 5, 1], 0),
            ([1, 1, 1], 0),
        ] {
            let place = (cell[0] + 4 * (cell[1] + 6 * cell[2])) as f64 / 47.0;
            let found = at_face(&picture, extents, cell, axis);
            let wanted = colour(place, axis);
            assert!(near(found, wanted), "{cell:?} along {axis}: {found:?} instead of {wanted:?}");
        }
        assert_eq!(picture.pixel(5, 595), [255; 3]);
    }

    #[test]
    fn hidden_cells_are_not_drawn() {
        let extents = [2, 1, 1];
        let picture = BlockPicture::new(extents, Scalar::new("t", &[0.0, 1.0]));
        let hidden = BlockPicture { hidden: Some(&[false, true]), ..picture.clone() };
        let [all, some] =
            [picture, hidden].map(|picture| at_face(&picture.render().unwrap(), extents, [1, 0, 0], 2));
        assert!(near(all, colour(1.0, 2)), "{all:?}");
        assert!(!near(some, all), "{some:?}");
    }

    #[test]
    fn empty_cells_are_not_drawn() {
        let extents = [5, 5, 5];
        let mut values = vec![0.0; 125];
        let drawn = |values: &[f64]| {
            let picture =
                BlockPicture { empty: Some(0.0), ..BlockPicture::new(extents, Scalar::new("t", values)) };
            let categories = [Category::new(0, 0.0, "0"), Category::new(1, 1.0, "1")];
            BlockPicture { categories: &categories, ..picture }.render().unwrap()
        };
        let none = drawn(&values);
        values[62] = 1.0;
        let one = drawn(&values);
        let differing: Vec<[f64; 2]> = (0..800 * 600)
            .filter(|i| none.pixel(i % 800, i / 800) != one.pixel(i % 800, i / 800))
            .map(|i| [(i % 800) as f64, (i / 800) as f64])
            .collect();
        // One cube in the middle is a hexagon of three rhombuses, each with the area 1 / sqrt(3).
        let eye = eye(extents);
        let area = 3.0_f64.sqrt() * eye.scale * eye.scale;
        assert!((differing.len() as f64 / area - 1.0).abs() < 0.05, "{} {area}", differing.len());
        for axis in 0..2 {
            let mean = differing.iter().map(|p| p[axis] + 0.5).sum::<f64>() / differing.len() as f64;
            assert!((mean - eye.centre[axis]).abs() < 1.0, "{mean} {:?}", eye.centre);
        }
    }

    #[test]
    fn what_cannot_be_drawn_is_said() {
        let error = |extents, size, n: usize| {
            let values = vec![0.0; n];
            let picture = BlockPicture::new(extents, Scalar::new("t", &values));
            BlockPicture { size, ..picture }.render().unwrap_err().to_string()
        };
        assert_eq!(error([3, 2, 2], [800, 600], 5), "cannot draw `t`: 5 values for 12 cells");
        assert!(error([3, 0, 2], [800, 600], 0).contains("3 by 0 cells"));
        assert!(error([1, 1, 1], [100, 600], 1).contains("100 by 600"));
    }
}
