//! Colours and colour maps.
//!
//! Light adds up in *linear* RGB. Files hold *encoded* (sRGB) values. Both are `[f32; 3]` from 0 to 1 here.
//! The names of functions and fields say which.

/// A colour map.
///
/// The maps are paths through Oklab. In Oklab equal steps look equal, so a map adds no false edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum ColourMap {
    /// From dark violet through blue and green to yellow, with increasing lightness. For magnitudes.
    #[default]
    Sequential,
    /// From blue through near-white to red. For signed values, with a range symmetric about zero.
    Diverging,
    /// From near-white to dark blue. For shares and densities on paper.
    Paper,
}

impl ColourMap {
    /// The points of the map: lightness, chroma and hue in degrees, at equal distances.
    fn path(self) -> &'static [[f32; 3]] {
        match self {
            Self::Sequential => &[
                [0.37, 0.145, 300.0],
                [0.46, 0.165, 278.0],
                [0.55, 0.132, 252.0],
                [0.64, 0.101, 210.0],
                [0.73, 0.124, 165.0],
                [0.83, 0.170, 130.0],
                [0.93, 0.165, 103.0],
            ],
            Self::Diverging => &[
                [0.40, 0.140, 262.0],
                [0.62, 0.120, 250.0],
                [0.82, 0.060, 240.0],
                [0.96, 0.000, 240.0],
                [0.82, 0.075, 40.0],
                [0.62, 0.160, 32.0],
                [0.42, 0.155, 25.0],
            ],
            Self::Paper => &[[0.975, 0.010, 240.0], [0.66, 0.110, 245.0], [0.30, 0.090, 262.0]],
        }
    }

    /// The colour at `t`, from 0 to 1, in linear RGB. Values beyond an end have the colour of that end. NaN
    /// has the colour of the lower end.
    #[must_use]
    pub fn linear(self, t: f64) -> [f32; 3] {
        let path = self.path();
        let last = path.len() - 1;
        let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
        let place = t as f32 * last as f32;
        let from = (place as usize).min(last.saturating_sub(1));
        let share = place - from as f32;
        // Interpolate linearly in Oklab. The hue of a point without chroma then does not matter.
        let [a, b] = [oklab(path[from]), oklab(path[(from + 1).min(last)])];
        linear_of_oklab(mix(a, b, share)).map(|x| x.clamp(0.0, 1.0))
    }

    /// The colours at 256 equal distances along the map, in linear RGB.
    pub(super) fn table(self) -> Vec<[f32; 3]> {
        (0..256).map(|i| self.linear(f64::from(i) / 255.0)).collect()
    }
}

/// Mixes `a` and `b`. `share` is the share of `b`.
pub(super) fn mix(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
}

/// Converts lightness, chroma and hue in degrees to Oklab's lightness and two axes.
fn oklab([lightness, chroma, hue]: [f32; 3]) -> [f32; 3] {
    let (sin, cos) = hue.to_radians().sin_cos();
    [lightness, chroma * cos, chroma * sin]
}

/// Converts an Oklab colour to linear RGB (B. Ottosson, "A perceptual color space for image processing",
/// 2020). The result is outside 0 to 1 if no screen can show the colour.
fn linear_of_oklab([l, a, b]: [f32; 3]) -> [f32; 3] {
    let long = (l + 0.396_337_78 * a + 0.215_803_76 * b).powi(3);
    let medium = (l - 0.105_561_346 * a - 0.063_854_17 * b).powi(3);
    let short = (l - 0.089_484_18 * a - 1.291_485_5 * b).powi(3);
    [
        4.076_741_7 * long - 3.307_711_6 * medium + 0.230_969_94 * short,
        -1.268_438 * long + 2.609_757_4 * medium - 0.341_319_38 * short,
        -0.004_196_086_3 * long - 0.703_418_6 * medium + 1.707_614_7 * short,
    ]
}

/// Converts linear RGB to encoded RGB.
pub fn encode(linear: [f32; 3]) -> [f32; 3] {
    linear.map(|x| {
        let x = x.clamp(0.0, 1.0);
        if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
    })
}

/// Converts encoded RGB to linear RGB.
pub(super) fn decode(encoded: [u8; 3]) -> [f32; 3] {
    encoded.map(|byte| {
        let x = f32::from(byte) / 255.0;
        if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The relative luminance of a linear colour.
    fn luminance([r, g, b]: [f32; 3]) -> f32 {
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn oklab_white_black_and_red_are_where_they_belong() {
        for (oklab, rgb) in [
            ([1.0, 0.0, 0.0], [1.0, 1.0, 1.0]),
            ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
            ([0.627_955, 0.224_863, 0.125_846], [1.0, 0.0, 0.0]),
        ] {
            let found = linear_of_oklab(oklab);
            for i in 0..3 {
                assert!((found[i] - rgb[i]).abs() < 2e-3, "{oklab:?} gives {found:?}");
            }
        }
    }

    #[test]
    fn the_sequential_map_grows_ever_lighter() {
        let table = ColourMap::Sequential.table();
        assert!(table.windows(2).all(|pair| luminance(pair[0]) < luminance(pair[1])));
        let steps = |map: ColourMap| {
            let table = map.table();
            table
                .windows(2)
                .map(|p| (0..3).map(|i| (encode(p[0])[i] - encode(p[1])[i]).abs()).fold(0.0, f32::max))
                .fold(0.0, f32::max)
        };
        for map in [ColourMap::Sequential, ColourMap::Diverging, ColourMap::Paper] {
            assert!(steps(map) < 0.025, "{map:?} has a jump of {}", steps(map));
        }
    }

    #[test]
    fn a_screen_can_show_every_colour() {
        let shown = |oklab| linear_of_oklab(oklab).iter().all(|x| (-0.004..=1.004).contains(x));
        for map in [ColourMap::Sequential, ColourMap::Diverging, ColourMap::Paper] {
            for pair in map.path().windows(2) {
                for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let point = mix(oklab(pair[0]), oklab(pair[1]), share);
                    assert!(
                        shown(point),
                        "{map:?} between {pair:?} at {share}: {:?}",
                        linear_of_oklab(point)
                    );
                }
            }
        }
    }

    #[test]
    fn values_beyond_the_ends_have_the_colour_of_the_end() {
        let map = ColourMap::Diverging;
        assert_eq!(map.linear(-1.0), map.linear(0.0));
        assert_eq!(map.linear(7.0), map.linear(1.0));
        assert!(map.linear(f64::NAN).iter().all(|x| x.is_finite()));
    }

    #[test]
    fn encoding_meets_the_known_points() {
        let [a, b, c] = encode([0.0, 0.214_041_14, 1.0]);
        assert!(a == 0.0 && (b - 0.5).abs() < 1e-4 && (c - 1.0).abs() < 1e-6);
    }
}
