//! Coordinates along the edges of a drawing.

use super::canvas::{Canvas, Strokes};
use super::legend::{FAINT_INK, INK};
use super::text::{self, Anchor, Style};
use crate::ticks::coordinates;

/// The axes of a layer. Ticks are outside the frame, at the left and below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes<'a> {
    /// The names of the horizontal and the vertical axis, with units: `easting (m)`.
    pub names: [&'a str; 2],
    /// The coordinates of the lower left corner of the layer.
    pub corner: [f64; 2],
}

/// The length of a tick from the frame, in pixels.
const TICK: f32 = 6.0;
/// The distance of the labels from the frame, in pixels.
const GAP: f32 = 10.0;
/// The height of a capital in the labels, in pixels.
const HEIGHT: f32 = 9.0;
/// The approximate distance between ticks, in pixels.
const APART: usize = 70;
/// The least distance between two labels, in pixels.
const BETWEEN: f32 = 12.0;

/// A drawing: its place on the canvas and its coordinates.
pub(super) struct Drawn {
    /// The first pixel of the drawing, from the top left.
    pub(super) corner: [usize; 2],
    /// The pixels of the drawing.
    pub(super) size: [usize; 2],
    /// The width and the height of the layer, in the unit of the coordinates.
    pub(super) lengths: [f64; 2],
    /// The range of pixel columns for labels.
    pub(super) columns: [f32; 2],
}

impl Axes<'_> {
    /// Draws the ticks with their labels, and the names of the axes.
    pub(super) fn draw(&self, canvas: &mut Canvas, drawn: &Drawn) {
        if !drawn.lengths.iter().chain(&self.corner).all(|length| length.is_finite()) {
            return;
        }
        self.draw_horizontal(canvas, drawn);
        self.draw_vertical(canvas, drawn);
    }

    fn draw_horizontal(&self, canvas: &mut Canvas, drawn: &Drawn) {
        let ([left, top], [width, height]) = (drawn.corner, drawn.size);
        let below = (top + height) as f32 + 1.0;
        let marks = self.marks(0, drawn, |text| text::width(text, &label()) + BETWEEN);
        let mut segments = Vec::new();
        for Mark { place, text } in marks {
            let x = (left as f64 + place).floor() as f32 + 0.5;
            segments.push([[x, below], [x, below + TICK]]);
            let reach = text::width(&text, &label()) / 2.0;
            if x - reach >= drawn.columns[0] && x + reach <= drawn.columns[1] {
                text::draw(canvas, &text, [x, below + TICK + 4.0 + HEIGHT], Anchor::Middle, &label());
            }
        }
        canvas.stroke(&Strokes { segments, width: 1.0 }, INK);
        let middle = [left as f32 + width as f32 / 2.0, below + TICK + 4.0 + 2.9 * HEIGHT];
        let reach = text::width(self.names[0], &label()) / 2.0;
        let middle = [middle[0].max(drawn.columns[0] + reach), middle[1]];
        text::draw(canvas, self.names[0], middle, Anchor::Middle, &label());
    }

    fn draw_vertical(&self, canvas: &mut Canvas, drawn: &Drawn) {
        let ([left, top], [_, height]) = (drawn.corner, drawn.size);
        let beside = left as f32 - 1.0;
        let marks = self.marks(1, drawn, |_| HEIGHT + BETWEEN);
        let room = beside - GAP - drawn.columns[0];
        let mut segments = Vec::new();
        for Mark { place, text } in marks {
            let y = ((top + height) as f64 - place).ceil() as f32 - 0.5;
            segments.push([[beside - TICK, y], [beside, y]]);
            let style = text::fitted(&text, label(), room);
            text::draw(canvas, &text, [beside - GAP, y + style.height / 2.0], Anchor::Right, &style);
        }
        canvas.stroke(&Strokes { segments, width: 1.0 }, INK);
        let right = (beside - GAP).max(drawn.columns[0] + text::width(self.names[1], &label()));
        let name = [right, top as f32 - GAP - HEIGHT];
        text::draw(canvas, self.names[1], name, Anchor::Right, &label());
    }

    /// As many round coordinates along an axis as fit. A label takes as many pixels as `room` returns for its
    /// text.
    fn marks(&self, axis: usize, drawn: &Drawn, room: impl Fn(&str) -> f32) -> Vec<Mark> {
        let (low, length, pixels) = (self.corner[axis], drawn.lengths[axis], drawn.size[axis]);
        // Rounded, so that a coordinate between two pixels does not count for the pixel before.
        let place = |value: f64| ((value - low) / length * pixels as f64 * 1e6).round() / 1e6;
        let of_number = |wanted: usize| -> Vec<Mark> {
            let all = coordinates(low, low + length, wanted).into_iter();
            // A tick at the end of the drawing belongs to the last pixel.
            let last = pixels as f64 - 0.5;
            all.map(|(value, text)| Mark { place: place(value).clamp(0.0, last), text }).collect()
        };
        let has_room = |marks: &Vec<Mark>| {
            let widest = marks.iter().map(|mark| room(&mark.text)).fold(0.0, f32::max);
            marks.windows(2).all(|pair| pair[1].place - pair[0].place >= f64::from(widest))
        };
        (1..=pixels / APART).rev().map(of_number).find(has_room).unwrap_or_default()
    }
}

/// A round coordinate.
struct Mark {
    /// The distance from the corner of the drawing, in pixels.
    place: f64,
    text: String,
}

fn label() -> Style {
    Style { height: HEIGHT, colour: FAINT_INK }
}
