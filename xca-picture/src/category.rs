//! Categories: values that stand for kinds or states, each with a name and a colour.

use super::colour::{decode, encode};

/// A value that stands for a kind or a state.
#[derive(Debug, Clone, PartialEq)]
pub struct Category {
    /// The value.
    pub value: f64,
    /// The name in the legend.
    pub name: String,
    /// Its colour in sRGB.
    pub colour: [u8; 3],
}

impl Category {
    /// A category with a colour of the palette. The first colour is nearly white, for dead, empty or false.
    /// Colour-blind readers can distinguish all ten colours. After ten they repeat.
    #[must_use]
    pub fn new(number: usize, value: f64, name: impl Into<String>) -> Self {
        Self { value, name: name.into(), colour: PALETTE[number % PALETTE.len()] }
    }

    /// The colour in linear RGB.
    pub fn linear(&self) -> [f32; 3] {
        decode(self.colour)
    }

    /// The colour in encoded RGB, from 0 to 1.
    pub(super) fn encoded(&self) -> [f32; 3] {
        encode(self.linear())
    }

    /// The index of the category of a value.
    pub fn number_of(categories: &[Self], value: f64) -> Option<usize> {
        categories.iter().position(|category| category.value == value)
    }
}

/// Near-white, navy, the colours of Okabe and Ito (orange, sky blue, bluish green, vermilion, reddish purple,
/// yellow), black and blue.
const PALETTE: [[u8; 3]; 10] = [
    [246, 246, 250],
    [26, 52, 98],
    [230, 159, 0],
    [86, 180, 233],
    [0, 158, 115],
    [213, 94, 0],
    [204, 121, 167],
    [240, 228, 66],
    [0, 0, 0],
    [60, 60, 235],
];

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f32; 3]; 3];

    /// Simulates vision without red and without green cones, in linear RGB (Machado, Oliveira and Fernandes,
    /// 2009).
    const WITHOUT_RED: Matrix = [
        [0.152_286, 1.052_583, -0.204_868],
        [0.114_503, 0.786_281, 0.099_216],
        [-0.003_882, -0.048_116, 1.051_998],
    ];
    const WITHOUT_GREEN: Matrix = [
        [0.367_322, 0.860_646, -0.227_968],
        [0.280_085, 0.672_501, 0.047_413],
        [-0.011_82, 0.042_94, 0.968_881],
    ];
    const WHOLE: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const TO_CONES: Matrix = [
        [0.412_221_46, 0.536_332_55, 0.051_445_995],
        [0.211_903_5, 0.680_699_5, 0.107_396_96],
        [0.088_302_46, 0.281_718_85, 0.629_978_7],
    ];
    const TO_OKLAB: Matrix = [
        [0.210_454_26, 0.793_617_8, -0.004_072_047],
        [1.977_998_5, -2.428_592_2, 0.450_593_7],
        [0.025_904_037, 0.782_771_77, -0.808_675_77],
    ];

    fn times(matrix: Matrix, vector: [f32; 3]) -> [f32; 3] {
        matrix.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum())
    }

    fn distance(one: [f32; 3], other: [f32; 3]) -> f32 {
        one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt()
    }

    #[test]
    fn all_eyes_tell_the_colours_apart() {
        for (eye, seen) in [("whole", WHOLE), ("no red", WITHOUT_RED), ("no green", WITHOUT_GREEN)] {
            let oklab = |colour: [u8; 3]| {
                let visible = times(seen, decode(colour)).map(|part| part.clamp(0.0, 1.0));
                times(TO_OKLAB, times(TO_CONES, visible).map(f32::cbrt))
            };
            for (number, one) in PALETTE.iter().enumerate() {
                for other in &PALETTE[..number] {
                    let apart = distance(oklab(*one), oklab(*other));
                    // A third of the distance between grey and orange.
                    assert!(apart > 0.07, "{one:?} and {other:?} are {apart} apart ({eye})");
                }
            }
        }
    }

    #[test]
    fn colours_repeat_and_values_are_found() {
        let all: Vec<Category> =
            (0..12).map(|number| Category::new(number, number as f64, number.to_string())).collect();
        assert_eq!((all[11].colour, all[11].name.as_str()), (all[1].colour, "11"));
        assert_eq!(Category::number_of(&all, 7.0), Some(7));
        assert_eq!(Category::number_of(&all, 7.5), None);
        let [r, g, b] = all[2].encoded().map(|part| (part * 255.0).round() as u8);
        assert_eq!([r, g, b], all[2].colour);
    }
}
