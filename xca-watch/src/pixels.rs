//! What a state looks like in so many pixels.

use super::colours::Colours;
use super::window::Window;
use xca_picture::{Category, DepthBuffer, Disc, Mosaic, Palette, Scalar, Scale};
use xca_record::record::{Sight, Subject};

/// What is behind items, in linear RGB.
const BEHIND: [f32; 3] = [0.010, 0.012, 0.018];
/// How much darker the furthest items are, and the rims of those that are large enough to look round.
const DUSK: f32 = 0.5;
const RIM: f32 = 0.5;
/// The radius in pixels from which an item looks round.
const ROUND: f32 = 2.0;

/// Pixels in linear RGB, row by row from the top left.
pub(super) struct Pixels {
    pub(super) width: usize,
    pub(super) height: usize,
    colours: Vec<[f32; 3]>,
}

impl Pixels {
    fn new([width, height]: [usize; 2], colour: [f32; 3]) -> Self {
        Self { width, height, colours: vec![colour; width * height] }
    }

    /// The colour of a pixel, if it is one.
    pub(super) fn get(&self, x: usize, y: usize) -> Option<[f32; 3]> {
        if x < self.width { self.colours.get(y * self.width + x).copied() } else { None }
    }

    fn set(&mut self, x: usize, y: usize, colour: [f32; 3]) {
        self.colours[y * self.width + x] = colour;
    }
}

/// The axes that run across and up where one looks along an axis.
fn plane_axes(axis: usize) -> [usize; 2] {
    match axis {
        0 => [1, 2],
        1 => [0, 2],
        _ => [0, 1],
    }
}

/// The axis that items are looked at along: from the front, or from above where they lie in a plane.
pub(super) fn looked_along(axis: Option<usize>, extents: [usize; 3]) -> usize {
    axis.unwrap_or(if extents[2] == 1 { 2 } else { 1 })
}

/// The cells across and down of what is seen.
pub(super) fn plane(subject: &Subject, axis: Option<usize>) -> [usize; 2] {
    match subject {
        Subject::Layer { cells, .. } => *cells,
        Subject::Items { extents, .. } => plane_axes(looked_along(axis, *extents)).map(|axis| extents[axis]),
    }
}

/// The scale of the colours.
pub(super) fn scale(sight: &Sight) -> Scale {
    Scalar { range: sight.range, ..Scalar::new("", &sight.values) }.scale()
}

/// Draws what is in the window. `axis` is where items are looked at from, if that is chosen.
pub(super) fn pixels(
    sight: &Sight,
    window: Window,
    axis: Option<usize>,
    palette: &Palette,
    colours: Colours,
) -> Pixels {
    match &sight.subject {
        Subject::Layer { cells, .. } => of_layer(sight, *cells, window, palette),
        Subject::Items { positions, radius, extents } => {
            let items = Items { positions, radius: *radius, extents: *extents };
            let axis = looked_along(axis, *extents);
            of_items(sight, &items, window, axis, palette, colours)
        }
    }
}

fn of_layer(sight: &Sight, cells: [usize; 2], window: Window, palette: &Palette) -> Pixels {
    let [columns, rows] = window.cells;
    let row = |row: usize| {
        let from = (window.first[1] + row) * cells[0] + window.first[0];
        from..from + columns
    };
    let values: Vec<f64> = (0..rows).flat_map(|y| &sight.values[row(y)]).copied().collect();
    let shown =
        |hidden: &Vec<bool>| -> Vec<bool> { (0..rows).flat_map(|y| &hidden[row(y)]).copied().collect() };
    let hidden = sight.hidden.as_ref().map(shown);
    let kinds: Vec<f64> = sight.kinds.iter().map(|kind| kind.value).collect();
    let mosaic = Mosaic::new([columns, rows], &values, &kinds, scale(sight), palette);
    let mut pixels = Pixels::new(window.pixels, [0.0; 3]);
    mosaic.without(hidden.as_deref()).draw(window.pixels, |x, y, colour| pixels.set(x, y, colour));
    pixels
}

struct Items<'a> {
    positions: &'a [[f64; 3]],
    radius: f64,
    extents: [usize; 3],
}

/// Items without perspective, the nearest in front.
fn of_items(
    sight: &Sight,
    items: &Items<'_>,
    window: Window,
    axis: usize,
    palette: &Palette,
    colours: Colours,
) -> Pixels {
    let [width, height] = window.pixels;
    let [right, up] = plane_axes(axis);
    let side: [f64; 2] = std::array::from_fn(|i| window.pixels[i] as f64 / window.cells[i] as f64);
    let depth = items.extents[axis] as f64;
    let mut nearest = DepthBuffer::new(width, height);
    let mut discs = Vec::with_capacity(items.positions.len());
    for (owner, position) in (0..).zip(items.positions) {
        // The eye is at the low end of y, and at the high end of x and z.
        let far = if axis == 1 { position[1] } else { depth - position[axis] };
        let x = (position[right] - window.first[0] as f64) * side[0];
        let y = height as f64 - (position[up] - window.first[1] as f64) * side[1];
        let (radius, thickness) = ((items.radius * side[0]) as f32, items.radius as f32);
        let disc = Disc { at: [x as f32, y as f32], radius, depth: far as f32, thickness };
        nearest.draw(disc, owner);
        discs.push(disc);
    }
    let scale = scale(sight);
    let mut pixels = Pixels::new(window.pixels, if colours == Colours::None { [0.0; 3] } else { BEHIND });
    for y in 0..height {
        for x in 0..width {
            if let Some(owner) = nearest.owner(x, y) {
                let value = sight.values.get(owner).copied().unwrap_or(f64::NAN);
                let colour = if sight.kinds.is_empty() {
                    palette.of(scale.place(value))
                } else {
                    palette.kind(Category::number_of(&sight.kinds, value))
                };
                // With few colours, one that is darker looks like that of another value.
                let is_lit = colours == Colours::True;
                let light = if is_lit { light(&discs[owner], depth as f32, x, y) } else { 1.0 };
                pixels.set(x, y, colour.map(|c| c * light));
            }
        }
    }
    pixels
}

/// How much light a pixel of an item has.
fn light(disc: &Disc, depth: f32, x: usize, y: usize) -> f32 {
    let dusk = 1.0 - DUSK * (disc.depth / depth).clamp(0.0, 1.0);
    let [_, _, towards_the_eye] = disc.normal(x, y);
    if disc.radius < ROUND { dusk } else { dusk * (1.0 - RIM * (1.0 - towards_the_eye)) }
}
