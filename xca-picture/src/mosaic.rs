//! A layer of cells, drawn in any number of pixels.

use super::averaging::Share;
use super::category::Category;
use super::colour::ColourMap;
use super::legend::Scale;
use super::relief::Ground;
use xca_io::lattice::Lattice;

/// The colour of cells without a value, in linear RGB.
pub(super) const GREY: [f32; 3] = [0.35, 0.35, 0.35];

/// The colours of values, in linear RGB.
#[derive(Debug, Clone)]
pub struct Palette {
    map: Vec<[f32; 3]>,
    kinds: Vec<[f32; 3]>,
    unknown: [f32; 3],
}

impl Palette {
    /// The colours of a colour map, and of categories.
    pub fn coloured(map: ColourMap, kinds: &[Category]) -> Self {
        Self { map: map.table(), kinds: kinds.iter().map(Category::linear).collect(), unknown: GREY }
    }

    /// Greys of increasing lightness, from `darkest` to 1, for values and for categories.
    pub fn shades(darkest: f32, kinds: usize) -> Self {
        let shades = |number: usize| {
            let last = number.saturating_sub(1).max(1) as f32;
            (0..number).map(|i| [darkest + (1.0 - darkest) * i as f32 / last; 3]).collect()
        };
        Self { map: shades(256), kinds: shades(kinds), unknown: [0.5; 3] }
    }

    /// The colour at a position of the scale, from 0 to 1.
    pub fn of(&self, place: Option<f64>) -> [f32; 3] {
        let entry = place.and_then(|place| self.map.get((place * 255.0).round() as usize));
        entry.copied().unwrap_or(self.unknown)
    }

    /// The colour of the category with this index.
    pub fn kind(&self, number: Option<usize>) -> [f32; 3] {
        number.and_then(|number| self.kinds.get(number)).copied().unwrap_or(self.unknown)
    }
}

/// A layer of cells, x fastest, the lowest y first. A cell without a value has the palette's colour for
/// unknown values.
#[derive(Debug)]
pub struct Mosaic<'a> {
    columns: usize,
    rows: usize,
    values: &'a [f64],
    scale: Scale,
    /// The values of the categories, if not empty. Other values are unknown.
    kinds: &'a [f64],
    palette: &'a Palette,
    /// The ground below the layer.
    ground: Option<&'a Ground>,
    /// The cells that are not drawn.
    hidden: Option<&'a [bool]>,
    lattice: Lattice,
}

impl<'a> Mosaic<'a> {
    /// A layer of magnitudes or of categories, without ground.
    pub fn new(
        [columns, rows]: [usize; 2],
        values: &'a [f64],
        kinds: &'a [f64],
        scale: Scale,
        palette: &'a Palette,
    ) -> Self {
        Self {
            columns,
            rows,
            values,
            scale,
            kinds,
            palette,
            ground: None,
            hidden: None,
            lattice: Lattice::Squares,
        }
    }

    /// Sets the ground.
    pub(super) fn over(self, ground: Option<&'a Ground>) -> Self {
        Self { ground, ..self }
    }

    /// Sets the lattice.
    #[must_use]
    pub fn on(self, lattice: Lattice) -> Self {
        Self { lattice, ..self }
    }

    /// Hides the cells where this mask is true. The background shows there.
    #[must_use]
    pub fn without(self, hidden: Option<&'a [bool]>) -> Self {
        Self { hidden, ..self }
    }

    /// Calls `set` with the column and row of each pixel, from the top left, and its colour. The colour is
    /// that of its cell, or of the mean of its cells. Skips pixels whose cells are all hidden, and pixels
    /// outside all hexagons.
    pub fn draw(&self, [width, height]: [usize; 2], mut set: impl FnMut(usize, usize, [f32; 3])) {
        if self.columns == 0 || self.rows == 0 {
            return;
        }
        if self.lattice != Lattice::Squares {
            return self.draw_hexagons([width, height], set);
        }
        let across: Vec<Share> = (0..width).map(|x| Share::new(x, width, self.columns)).collect();
        for y in 0..height {
            // The first row of cells is at the bottom.
            let down = Share::new(height - 1 - y, height, self.rows);
            for (x, across) in across.iter().enumerate() {
                let cells = down.cells().flat_map(|(row, a)| {
                    across.cells().map(move |(column, b)| (row * self.columns + column, a * b))
                });
                if let Some(colour) = self.colour(cells) {
                    set(x, y, colour);
                }
            }
        }
    }

    /// Takes several samples of each pixel: two per cell in each direction, from 3 to 8.
    fn draw_hexagons(&self, pixels: [usize; 2], mut set: impl FnMut(usize, usize, [f32; 3])) {
        let cells = [self.columns, self.rows];
        let size = self.lattice.size(cells);
        let [width, height] = std::array::from_fn(|i| size[i] / pixels[i] as f64);
        let points = ((2.0 * f64::max(width, height)).ceil() as usize).clamp(3, 8);
        let part = |point: usize| (point as f64 + 0.5) / points as f64;
        for y in 0..pixels[1] {
            for x in 0..pixels[0] {
                let from_below = (pixels[1] - 1 - y) as f64;
                let of_pixel = (0..points * points).filter_map(|point| {
                    let u = (x as f64 + part(point % points)) * width;
                    let v = (from_below + part(point / points)) * height;
                    let [column, row] = self.lattice.cell_at([u, v], cells)?;
                    Some((row * self.columns + column, 1.0))
                });
                if let Some(colour) = self.colour(of_pixel) {
                    set(x, y, colour);
                }
            }
        }
    }

    fn value(&self, cell: usize) -> f64 {
        self.values.get(cell).copied().unwrap_or(f64::NAN)
    }

    fn is_hidden(&self, cell: usize) -> bool {
        self.hidden.is_some_and(|hidden| hidden.get(cell) == Some(&true))
    }

    /// The colour of a pixel with these shares of cells.
    fn colour(&self, cells: impl Iterator<Item = (usize, f64)>) -> Option<[f32; 3]> {
        let mut cells = cells.filter(|(cell, _)| !self.is_hidden(*cell)).peekable();
        cells.peek()?;
        if self.kinds.is_empty() && self.ground.is_none() {
            let (sum, weight) = cells
                .map(|(cell, weight)| (self.value(cell), weight))
                .filter(|(value, _)| value.is_finite())
                .fold((0.0, 0.0), |(sum, weight), (value, w)| (sum + value * w, weight + w));
            return Some(self.palette.of(self.scale.place(sum / weight)));
        }
        let (sum, weight) = cells.fold(([0.0_f32; 3], 0.0), |(sum, weight), (cell, w)| {
            let colour = self.colour_of(cell);
            (std::array::from_fn(|i| sum[i] + colour[i] * w as f32), weight + w as f32)
        });
        Some(sum.map(|c| c / weight))
    }

    /// The colour of a single cell.
    fn colour_of(&self, cell: usize) -> [f32; 3] {
        let value = self.value(cell);
        let own = if self.kinds.is_empty() {
            self.palette.of(self.scale.place(value))
        } else {
            self.palette.kind(self.kinds.iter().position(|kind| *kind == value))
        };
        self.ground.map_or(own, |ground| ground.colour(cell, value, own))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shades_run_from_the_darkest_to_white() {
        let palette = Palette::shades(0.5, 3);
        assert_eq!(palette.of(Some(0.0)), [0.5; 3]);
        assert_eq!(palette.of(Some(1.0)), [1.0; 3]);
        assert_eq!([0, 1, 2].map(|kind| palette.kind(Some(kind))[0]), [0.5, 0.75, 1.0]);
        // One category, and no category.
        assert_eq!(Palette::shades(0.25, 1).kind(Some(0)), [0.25; 3]);
        assert_eq!(palette.kind(None), palette.of(None));
    }
}
