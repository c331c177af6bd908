//! Colour scales, and the legends that explain them.

use super::PictureError;
use super::canvas::{Canvas, Strokes};
use super::category::Category;
use super::colour::{ColourMap, encode};
use super::text::{self, Anchor, Style};
use crate::ticks::ticks;
use xca_io::numbers::significant;

/// The colour of text and frames, in encoded RGB.
pub(super) const INK: [f32; 3] = [0.16, 0.18, 0.22];
/// The colour of less important text, in encoded RGB.
pub(super) const FAINT_INK: [f32; 3] = [0.42, 0.45, 0.50];

/// A scalar shown by colour: one value for each particle or cell.
#[derive(Debug, Clone, Copy)]
pub struct Scalar<'a> {
    /// The name with its unit. `^` begins a superscript: `speed (m s^-1)`.
    pub label: &'a str,
    /// The values. Values that are not finite are drawn in grey.
    pub values: &'a [f64],
    /// The values at the ends of the colour map. `None`: the least and the largest finite value.
    pub range: Option<[f64; 2]>,
    /// The colour map.
    pub map: ColourMap,
}

impl<'a> Scalar<'a> {
    /// A scalar in the default colours, from its least to its largest value.
    #[must_use]
    pub fn new(label: &'a str, values: &'a [f64]) -> Self {
        Self { label, values, range: None, map: ColourMap::default() }
    }

    /// Sets a range that leaves out the given share of the values, from 0 to 1, at its upper end. A few fast
    /// particles then do not make all others look alike. Values beyond the range have the colour of its end.
    #[must_use]
    pub fn without_largest(mut self, share: f64) -> Self {
        let mut finite: Vec<f64> = self.values.iter().copied().filter(|value| value.is_finite()).collect();
        if let Some(last) = finite.len().checked_sub(1) {
            let least = finite.iter().copied().fold(f64::INFINITY, f64::min);
            let place = ((last as f64 * (1.0 - share.clamp(0.0, 1.0))).round() as usize).min(last);
            let (_, &mut high, _) = finite.select_nth_unstable_by(place, f64::total_cmp);
            self.range = Some([least, high]);
        }
        self
    }

    pub(super) fn check(&self, expected: usize, of: &'static str) -> Result<(), PictureError> {
        let found = self.values.len();
        if found == expected {
            return Ok(());
        }
        Err(PictureError::Length { name: self.label.to_owned(), found, expected, of })
    }

    /// The scale from values to positions on the map.
    pub fn scale(&self) -> Scale {
        let found = || {
            let finite = self.values.iter().copied().filter(|value| value.is_finite());
            finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
        };
        match self.range.filter(|range| range.iter().all(|x| x.is_finite())).unwrap_or_else(found) {
            [low, high] if low <= high => Scale { low, high },
            [low, high] if low.is_finite() => Scale { low: high, high: low },
            // No value is finite.
            _ => Scale { low: 0.0, high: 0.0 },
        }
    }
}

/// The values at the ends of a colour map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// The value at the low end.
    pub low: f64,
    /// The value at the high end.
    pub high: f64,
}

impl Scale {
    /// The position of a value on the map, from 0 to 1. `None` if it is not finite.
    pub fn place(&self, value: f64) -> Option<f64> {
        if !value.is_finite() {
            return None;
        }
        // Halved, so that the range of nearly all numbers does not overflow.
        let span = self.high / 2.0 - self.low / 2.0;
        let place = if span > 0.0 { (value / 2.0 - self.low / 2.0) / span } else { 0.0 };
        Some(place.clamp(0.0, 1.0))
    }
}

/// Draws a vertical colour bar, its ticks to the right and its label above.
pub(super) fn draw_bar(
    canvas: &mut Canvas,
    [x, y]: [usize; 2],
    [w, h]: [usize; 2],
    label: &str,
    map: ColourMap,
    scale: Scale,
) {
    let style = Style { height: 11.0, colour: INK };
    let ticks = ticks(scale.low, scale.high, h / 70);
    let right = (x + w) as f32;
    let mut above = y as f32 - 20.0;
    if scale.high > scale.low {
        for j in 0..h {
            let colour = encode(map.linear(1.0 - (j as f64 + 0.5) / h as f64));
            canvas.fill([x, y + j], [w, 1], colour);
        }
        canvas.frame([x, y], [w, h], INK);
        for (value, text) in &ticks.marks {
            let at = y as f32 + h as f32 * (1.0 - scale.place(*value).unwrap_or(0.0) as f32);
            let at = at.clamp(y as f32 + 0.5, (y + h) as f32 - 0.5).floor() + 0.5;
            canvas
                .stroke(&Strokes { segments: vec![[[right + 1.0, at], [right + 5.0, at]]], width: 1.0 }, INK);
            text::draw(canvas, text, [right + 12.0, at + 5.5], Anchor::Left, &style);
        }
    } else {
        // A single value is a single swatch.
        let top = y + h / 2 - w / 2;
        canvas.fill([x, top], [w, w], encode(map.linear(0.0)));
        canvas.frame([x, top], [w, w], INK);
        let at = [right + 12.0, (top + w / 2) as f32 + 5.5];
        text::draw(canvas, &significant(scale.low, 4), at, Anchor::Left, &style);
        above = top as f32 - 20.0;
    }
    let left = x as f32 - 2.0;
    let room = canvas.width() as f32 - 14.0 - left;
    if ticks.exponent != 0 {
        text::draw(canvas, &format!("×10^{}", ticks.exponent), [left, above], Anchor::Left, &style);
        above -= 21.0;
    }
    text::draw(canvas, label, [left, above], Anchor::Left, &text::fitted(label, style, room));
}

/// Draws a list of categories with their colours, as far as there is room above `bottom`. Then draws the
/// number of categories left out.
pub(super) fn draw_categories(
    canvas: &mut Canvas,
    [x, y]: [usize; 2],
    bottom: usize,
    label: &str,
    categories: &[Category],
) {
    const LINE: usize = 26;
    let style = Style { height: 11.0, colour: INK };
    let room = canvas.width() as f32 - 14.0 - x as f32;
    text::draw(canvas, label, [x as f32, y as f32 - 10.0], Anchor::Left, &text::fitted(label, style, room));
    let lines = (bottom.saturating_sub(y + 8) / LINE).max(1);
    let shown = if categories.len() > lines { lines - 1 } else { categories.len() };
    for (i, category) in categories[..shown].iter().enumerate() {
        let top = y + 8 + LINE * i;
        canvas.fill([x, top], [16, 16], category.encoded());
        canvas.frame([x, top], [16, 16], INK);
        let name = &category.name;
        let fitted = text::fitted(name, style, room - 28.0);
        text::draw(canvas, name, [x as f32 + 28.0, top as f32 + 13.5], Anchor::Left, &fitted);
    }
    if shown < categories.len() {
        let more = format!("and {} more", categories.len() - shown);
        let top = (y + 8 + LINE * shown) as f32;
        text::draw(canvas, &more, [x as f32, top + 13.5], Anchor::Left, &style);
    }
}

/// Draws title and caption in the top left corner.
pub(super) fn draw_title(canvas: &mut Canvas, left: f32, title: &str, caption: &str) {
    let room = canvas.width() as f32 - 2.0 * left;
    for (text, height, colour, line) in [(title, 17.0, INK, 44.0), (caption, 11.5, FAINT_INK, 70.0)] {
        let style = text::fitted(text, Style { height, colour }, room);
        text::draw(canvas, text, [left, line], Anchor::Left, &style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_that_of_the_finite_values_or_as_given() {
        let values = [2.0, f64::NAN, -1.0, f64::INFINITY];
        let mut scalar = Scalar::new("a", &values);
        assert_eq!(scalar.scale(), Scale { low: -1.0, high: 2.0 });
        scalar.range = Some([5.0, 3.0]);
        assert_eq!(scalar.scale(), Scale { low: 3.0, high: 5.0 });
        scalar.range = Some([f64::NAN, 3.0]);
        assert_eq!(scalar.scale(), Scale { low: -1.0, high: 2.0 });
        assert_eq!(Scalar::new("a", &[]).scale(), Scale { low: 0.0, high: 0.0 });
        assert_eq!(Scalar::new("a", &[f64::NAN]).scale(), Scale { low: 0.0, high: 0.0 });
    }

    #[test]
    fn the_largest_values_can_be_left_out() {
        let values: Vec<f64> = (0..=100).rev().map(f64::from).chain([f64::NAN]).collect();
        assert_eq!(Scalar::new("a", &values).without_largest(0.02).range, Some([0.0, 98.0]));
        assert_eq!(Scalar::new("a", &values).without_largest(0.0).range, Some([0.0, 100.0]));
        assert_eq!(Scalar::new("a", &values).without_largest(f64::NAN).range, Some([0.0, 0.0]));
        assert_eq!(Scalar::new("a", &[]).without_largest(0.02).range, None);
    }

    #[test]
    fn places_run_from_0_to_1() {
        let scale = Scale { low: -1.0, high: 3.0 };
        assert_eq!(scale.place(0.0), Some(0.25));
        assert_eq!(scale.place(9.0), Some(1.0));
        assert_eq!(scale.place(f64::NAN), None);
        assert_eq!(Scale { low: 2.0, high: 2.0 }.place(2.0), Some(0.0));
        assert_eq!(Scale { low: f64::MIN, high: f64::MAX }.place(0.0), Some(0.5));
    }

    #[test]
    fn the_bar_runs_from_the_low_colour_below_to_the_high_one_above() {
        let mut canvas = Canvas::new(300, 400, [1.0; 3]);
        let scale = Scale { low: 0.0, high: 1.0 };
        draw_bar(&mut canvas, [100, 60], [20, 300], "speed", ColourMap::Sequential, scale);
        let picture = canvas.into_picture();
        let near = |found: [u8; 3], t: f64| {
            let wanted = encode(ColourMap::Sequential.linear(t)).map(|x| x * 255.0);
            (0..3).all(|i| (f32::from(found[i]) - wanted[i]).abs() < 3.0)
        };
        assert!(near(picture.pixel(110, 60), 1.0));
        assert!(near(picture.pixel(110, 359), 0.0));
        assert!(near(picture.pixel(110, 210), 0.5));
        assert_eq!(picture.pixel(110, 362), [255; 3]);
    }
}
