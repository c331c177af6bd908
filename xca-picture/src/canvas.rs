//! A canvas for rectangles, lines and text.

use super::Picture;
use super::colour::mix;

/// Pixels in encoded RGB, from the top left, row by row. Coordinates are in pixels. The middle of the first
/// pixel is at (0.5, 0.5). Everything outside is clipped.
pub(super) struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 3]>,
}

/// A set of strokes. They are drawn at once, so that crossings are not drawn twice.
#[derive(Default)]
pub(super) struct Strokes {
    /// Segments; a dot is a segment without length.
    pub(super) segments: Vec<[[f32; 2]; 2]>,
    /// The width of the round pen in pixels.
    pub(super) width: f32,
}

impl Canvas {
    pub(super) fn new(width: usize, height: usize, colour: [f32; 3]) -> Self {
        Self { width, height, pixels: vec![colour; width * height] }
    }

    pub(super) fn width(&self) -> usize {
        self.width
    }

    pub(super) fn height(&self) -> usize {
        self.height
    }

    pub(super) fn set(&mut self, x: usize, y: usize, colour: [f32; 3]) {
        if x < self.width && y < self.height {
            self.pixels[y * self.width + x] = colour;
        }
    }

    /// Blends `colour` over a pixel. `cover` is its share, from 0 to 1.
    pub(super) fn blend(&mut self, x: usize, y: usize, colour: [f32; 3], cover: f32) {
        if x < self.width && y < self.height {
            let pixel = &mut self.pixels[y * self.width + x];
            *pixel = mix(*pixel, colour, cover);
        }
    }

    /// Draws the outline of a rectangle, one pixel wide, just outside it.
    pub(super) fn frame(&mut self, [x, y]: [usize; 2], [w, h]: [usize; 2], colour: [f32; 3]) {
        for i in x.saturating_sub(1)..=x + w {
            self.set(i, y.wrapping_sub(1), colour);
            self.set(i, y + h, colour);
        }
        for j in y..y + h {
            self.set(x.wrapping_sub(1), j, colour);
            self.set(x + w, j, colour);
        }
    }

    /// Draws strokes in one colour.
    pub(super) fn stroke(&mut self, strokes: &Strokes, colour: [f32; 3]) {
        strokes.cover(self.width, self.height, |x, y, cover| self.blend(x, y, colour, cover));
    }

    /// Fills a rectangle.
    pub(super) fn fill(&mut self, [x, y]: [usize; 2], [w, h]: [usize; 2], colour: [f32; 3]) {
        for j in y..y + h {
            for i in x..x + w {
                self.set(i, j, colour);
            }
        }
    }

    /// Copies a picture to the rectangle with its top left corner at `[x, y]`.
    pub(super) fn paste(&mut self, [x, y]: [usize; 2], picture: &Picture) {
        let pixels = picture.rgb.as_chunks::<3>().0.iter().enumerate();
        for (at, pixel) in pixels {
            let colour = pixel.map(|channel| f32::from(channel) / 255.0);
            self.set(x + at % picture.width, y + at / picture.width, colour);
        }
    }

    /// The finished picture.
    pub(super) fn into_picture(self) -> Picture {
        let rgb = self.pixels.iter().flatten().map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8).collect();
        Picture { width: self.width, height: self.height, rgb }
    }
}

impl Strokes {
    /// Calls `paint` for each pixel that the pen touches, with the share of the pixel that it covers. The
    /// surface has `width` by `height` pixels.
    pub(super) fn cover(&self, width: usize, height: usize, mut paint: impl FnMut(usize, usize, f32)) {
        let reach = self.width / 2.0 + 1.0;
        let (mut low, mut high) = ([f32::MAX; 2], [f32::MIN; 2]);
        for point in self.segments.iter().flatten() {
            for i in 0..2 {
                low[i] = low[i].min(point[i] - reach);
                high[i] = high[i].max(point[i] + reach);
            }
        }
        // Casts of negative numbers give zero, also for an empty set.
        let (x0, y0) = (low[0] as usize, low[1] as usize);
        let (x1, y1) =
            ((high[0].max(0.0) as usize + 1).min(width), (high[1].max(0.0) as usize + 1).min(height));
        if self.segments.is_empty() || x0 >= x1 || y0 >= y1 {
            return;
        }
        let mut mask = vec![0.0_f32; (x1 - x0) * (y1 - y0)];
        for [a, b] in &self.segments {
            let clip = |v: f32, from: usize, to: usize| (v.max(from as f32) as usize).min(to);
            let columns = clip(a[0].min(b[0]) - reach, x0, x1)..clip(a[0].max(b[0]) + reach + 1.0, x0, x1);
            for y in clip(a[1].min(b[1]) - reach, y0, y1)..clip(a[1].max(b[1]) + reach + 1.0, y0, y1) {
                for x in columns.clone() {
                    let cover = self.width / 2.0 + 0.5 - distance([x as f32 + 0.5, y as f32 + 0.5], *a, *b);
                    let cell = &mut mask[(y - y0) * (x1 - x0) + x - x0];
                    *cell = cell.max(cover.min(1.0).min(self.width));
                }
            }
        }
        for (i, &cover) in mask.iter().enumerate().filter(|(_, cover)| **cover > 0.0) {
            paint(x0 + i % (x1 - x0), y0 + i / (x1 - x0), cover);
        }
    }
}

/// The distance of `p` from the segment from `a` to `b`.
fn distance(p: [f32; 2], a: [f32; 2], b: [f32; 2]) -> f32 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let length2 = dx * dx + dy * dy;
    let along = if length2 > 0.0 { ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2 } else { 0.0 };
    let along = along.clamp(0.0, 1.0);
    (p[0] - a[0] - along * dx).hypot(p[1] - a[1] - along * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHITE: [f32; 3] = [1.0; 3];
    const BLACK: [f32; 3] = [0.0; 3];

    #[test]
    fn a_line_is_as_dark_as_it_is_wide() {
        let mut canvas = Canvas::new(40, 20, WHITE);
        canvas.stroke(&Strokes { segments: vec![[[5.0, 10.0], [35.0, 10.0]]], width: 3.0 }, BLACK);
        let picture = canvas.into_picture();
        let ink: f64 = (0..20).map(|y| 1.0 - f64::from(picture.pixel(20, y)[0]) / 255.0).sum();
        assert!((ink - 3.0).abs() < 0.05, "{ink}");
        assert_eq!(picture.pixel(1, 10), [255; 3]);
        assert_eq!(picture.pixel(20, 2), [255; 3]);
    }

    #[test]
    fn strokes_that_cross_or_leave_the_surface_are_fine() {
        let mut canvas = Canvas::new(10, 10, WHITE);
        let far = [[-1e4, 5.0], [1e4, 5.0]];
        canvas.stroke(&Strokes { segments: vec![far, far], width: 0.5 }, BLACK);
        canvas.stroke(&Strokes { segments: vec![[[50.0, 50.0], [60.0, 60.0]]], width: 2.0 }, BLACK);
        canvas.stroke(&Strokes { segments: vec![[[-50.0, -50.0], [-60.0, -60.0]]], width: 2.0 }, BLACK);
        canvas.stroke(&Strokes::default(), BLACK);
        let picture = canvas.into_picture();
        assert_eq!(picture.pixel(0, 5), picture.pixel(9, 5));
        // Two equal strokes in one set leave ink once: a quarter of the pixel on either side.
        assert_eq!(picture.pixel(5, 4), [191; 3]);
        assert_eq!(picture.pixel(5, 5), [191; 3]);
        assert_eq!(picture.pixel(0, 0), [255; 3]);
        assert_eq!(picture.pixel(9, 9), [255; 3]);
    }

    #[test]
    fn a_frame_stays_outside_of_its_rectangle() {
        let mut canvas = Canvas::new(8, 8, WHITE);
        canvas.fill([2, 2], [4, 4], [1.0, 0.0, 0.0]);
        canvas.frame([2, 2], [4, 4], BLACK);
        canvas.frame([0, 0], [8, 8], BLACK);
        let picture = canvas.into_picture();
        assert_eq!(picture.pixel(2, 2), [255, 0, 0]);
        assert_eq!(picture.pixel(1, 2), [0; 3]);
        assert_eq!(picture.pixel(5, 6), [0; 3]);
        assert_eq!(picture.pixel(0, 0), [255; 3]);
    }
}
