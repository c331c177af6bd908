//! The palette of a GIF: at most 256 colours, the same in all its pictures.

use color_quant::NeuQuant;
use std::collections::HashMap;
use std::iter::repeat_n;

/// A colour in sRGB.
type Colour = [u8; 3];

/// The largest number of colours of a GIF.
const MOST: usize = 256;

/// The number of the most frequent colours that stay exact if there are too many colours: paper, ink and
/// large areas.
const KEPT: usize = 64;

/// The number of pixels of each colour.
#[derive(Default)]
pub(super) struct Histogram {
    counts: HashMap<Colour, u64>,
}

impl Histogram {
    /// Counts pixels, three bytes each.
    pub(super) fn add(&mut self, rgb: &[u8]) {
        // Equal pixels are often neighbours.
        for run in rgb.as_chunks::<3>().0.chunk_by(|one, next| one == next) {
            *self.counts.entry(run[0]).or_default() += run.len() as u64;
        }
    }

    /// The palette, and for each counted colour its entry.
    pub(super) fn palette(self) -> Palette {
        let mut all: Vec<(Colour, u64)> = self.counts.into_iter().collect();
        // The most frequent colours first. The order of equally frequent colours is fixed, so that equal
        // pictures give equal files.
        all.sort_unstable_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));
        let colours =
            if all.len() <= MOST { all.iter().map(|(colour, _)| *colour).collect() } else { few(&all) };
        let indices = all.iter().map(|(colour, _)| (*colour, nearest(&colours, *colour))).collect();
        Palette { colours, indices }
    }
}

/// The colours of an animation.
pub(super) struct Palette {
    colours: Vec<Colour>,
    indices: HashMap<Colour, u8>,
}

impl Palette {
    /// Three bytes for each colour.
    pub(super) fn rgb(&self) -> &[u8] {
        self.colours.as_flattened()
    }

    /// The palette indices of pixels. All colours must have been counted.
    pub(super) fn indices(&self, rgb: &[u8]) -> Vec<u8> {
        let pixels = rgb.as_chunks::<3>().0.iter();
        pixels.map(|colour| self.indices.get(colour).copied().unwrap_or(0)).collect()
    }
}

/// A few colours that represent `all`, which is sorted by frequency.
fn few(all: &[(Colour, u64)]) -> Vec<Colour> {
    let (kept, others) = all.split_at(KEPT);
    // Frequent colours weigh more, but not so much that rare colours are lost.
    let weighed = others.iter().flat_map(|(colour, count)| repeat_n(colour, 1 + count.ilog2() as usize));
    let pixels: Vec<u8> = weighed.flat_map(|&[red, green, blue]| [red, green, blue, u8::MAX]).collect();
    let found = NeuQuant::new(1, MOST - KEPT, &pixels).color_map_rgb();
    kept.iter().map(|(colour, _)| *colour).chain(found.as_chunks().0.iter().copied()).collect()
}

/// The index of the nearest colour.
fn nearest(colours: &[Colour], wanted: Colour) -> u8 {
    let distance = |colour: &Colour| -> i32 {
        (0..3).map(|i| (i32::from(colour[i]) - i32::from(wanted[i])).pow(2)).sum()
    };
    let found = colours.iter().enumerate().min_by_key(|(_, colour)| distance(colour));
    found.map_or(0, |(number, _)| number as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest difference of a channel between colours and their representatives, and the mean
    /// difference.
    fn error(colours: &[Colour]) -> (u8, f64) {
        let mut histogram = Histogram::default();
        histogram.add(colours.as_flattened());
        let palette = histogram.palette();
        assert!(palette.colours.len() <= MOST);
        let shown = palette.indices(colours.as_flattened());
        let channels = colours.iter().zip(shown).flat_map(|(colour, index)| {
            let shown = palette.colours[usize::from(index)];
            (0..3).map(move |i| colour[i].abs_diff(shown[i]))
        });
        let (mut largest, mut sum) = (0, 0.0);
        for difference in channels {
            largest = largest.max(difference);
            sum += f64::from(difference);
        }
        (largest, sum / (3 * colours.len()) as f64)
    }

    #[test]
    fn as_many_colours_as_there_is_room_for_stay_as_they_are() {
        let colours: Vec<Colour> = (0..=255).map(|i: u8| [i, i.wrapping_mul(37), 255 - i]).collect();
        assert_eq!(error(&colours), (0, 0.0));
        assert_eq!(error(&[[1, 2, 3]]), (0, 0.0));
    }

    #[test]
    fn more_colours_are_met_nearly() {
        // A colour map under light of many strengths, on much white.
        let mut colours = vec![[255; 3]; 20_000];
        for hue in 0..=255_u16 {
            for light in 20..100_u16 {
                colours.push([hue, 255 - hue / 2, 60 + hue / 3].map(|channel| (channel * light / 100) as u8));
            }
        }
        let (largest, mean) = error(&colours);
        assert!(largest <= 24 && mean < 2.5, "{largest} {mean}");
        // Colours all over the cube: the worst case.
        let cube: Vec<Colour> =
            (0..32_768_u32).map(|i| [i % 32, i / 32 % 32, i / 1024].map(|c| (8 * c) as u8)).collect();
        let (largest, mean) = error(&cube);
        assert!(largest <= 72 && mean < 16.0, "{largest} {mean}");
    }

    #[test]
    fn what_is_there_most_stays_as_it_is() {
        let mut colours: Vec<Colour> = (0..2000_u16).map(|i| [(i % 251) as u8, (i / 8) as u8, 90]).collect();
        colours.extend([[255; 3]; 100]);
        colours.extend([[41, 46, 56]; 50]);
        let mut histogram = Histogram::default();
        histogram.add(colours.as_flattened());
        let palette = histogram.palette();
        assert_eq!(palette.colours[..2], [[255; 3], [41, 46, 56]]);
        assert_eq!(palette.indices(&[41, 46, 56, 255, 255, 255]), [1, 0]);
    }
}
