//! Statistics of numbers of any size: they overflow only where their result does.

/// The mean; NaN of no numbers. That of finite numbers is finite, also where their sum overflows.
///
/// ```
/// use xca_core::statistics::mean;
///
/// assert_eq!(mean([1.0, 2.0, 6.0].into_iter()), 3.0);
/// assert_eq!(mean([1.5e308, 1.5e308].into_iter()), 1.5e308);
/// ```
pub fn mean(numbers: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = numbers.clone().count() as f64;
    let sum: f64 = numbers.clone().sum();
    if sum.is_finite() || count == 0.0 {
        return sum / count;
    }
    // Rounding could lift the mean of the largest number above it: therefore half of it.
    let half: f64 = numbers.map(|number| number / 2.0 / count).sum();
    if half.is_finite() { (2.0 * half).clamp(f64::MIN, f64::MAX) } else { half }
}

/// A scale at which squares of the largest numbers are finite, and its inverse for the smallest ones.
const SCALE: f64 = 1e-180;

/// Adds squares, for the root of their mean.
///
/// ```
/// use xca_core::statistics::Squares;
///
/// let mut squares = Squares::default();
/// [3.0, 4.0].into_iter().for_each(|number| squares.add(1e200 * number));
/// assert!((squares.root(1.0) / 5e200 - 1.0).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct Squares {
    plain: f64,
    /// Those of large numbers.
    scaled_down: f64,
    /// Those of small numbers.
    scaled_up: f64,
}

impl Squares {
    /// Adds the square of a number.
    pub fn add(&mut self, number: f64) {
        let (down, up) = (number * SCALE, number / SCALE);
        self.plain += number * number;
        self.scaled_down += down * down;
        self.scaled_up += up * up;
    }

    /// The root of their sum divided by `count`.
    pub fn root(self, count: f64) -> f64 {
        if self.plain.is_infinite() {
            (self.scaled_down / count).sqrt() / SCALE
        } else if self.plain < 1e-280 {
            (self.scaled_up / count).sqrt() * SCALE
        } else {
            (self.plain / count).sqrt()
        }
    }
}

/// Mean and standard deviation of a sample: NaN of no numbers, 0 of one.
pub fn mean_and_deviation(numbers: &[f64]) -> [f64; 2] {
    let mean = mean(numbers.iter().copied());
    let mut squares = Squares::default();
    numbers.iter().for_each(|number| squares.add(number - mean));
    [mean, if numbers.len() > 1 { squares.root(numbers.len() as f64 - 1.0) } else { 0.0 }]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(numbers: &[f64]) -> f64 {
        let mut squares = Squares::default();
        numbers.iter().for_each(|number| squares.add(*number));
        squares.root(numbers.len() as f64)
    }

    #[test]
    fn the_mean_of_the_largest_numbers_is_finite() {
        let mean = |numbers: &[f64]| mean(numbers.iter().copied());
        for (found, wanted) in [(mean(&[f64::MAX; 7]), f64::MAX), (mean(&[f64::MIN; 1001]), f64::MIN)] {
            assert!(found.is_finite() && (found / wanted - 1.0).abs() < 1e-13, "{found}");
        }
        assert_eq!(mean(&[1e308, 1e308, -1e308, -1e308]), 0.0);
        assert!((mean(&[1e308, 1e308, 1e308, 1e307]) / 7.75e307 - 1.0).abs() < 1e-15);
        assert_eq!(mean(&[0.1, 0.2]), (0.1 + 0.2) / 2.0);
        assert_eq!(mean(&[f64::INFINITY, 1.0]), f64::INFINITY);
        assert!(mean(&[]).is_nan() && mean(&[f64::NAN, 1.0]).is_nan());
        assert!(mean(&[f64::INFINITY, f64::NEG_INFINITY]).is_nan());
    }

    /// The root of a mean of squares grows as its numbers.
    #[test]
    fn roots_of_squares_hold_at_any_size() {
        for size in [1e-300, 1e-160, 1e-140, 1e-130, 1.0, 1e130, 1e150, 1e160, 1e300] {
            let found = root(&[size, 2.0 * size, 2.0 * size, 4.0 * size]);
            assert!((found / size / 2.5 - 1.0).abs() < 1e-14, "{size}: {found}");
        }
        assert_eq!(root(&[3.0, 4.0]), 12.5_f64.sqrt());
        assert_eq!((root(&[0.0, 0.0]), root(&[f64::INFINITY, 1.0])), (0.0, f64::INFINITY));
        assert!(root(&[f64::NAN, 1.0]).is_nan());
        let [mean, deviation] = mean_and_deviation(&[1e300, 3e300]);
        assert!(mean == 2e300 && (deviation / 1e300 / 2.0_f64.sqrt() - 1.0).abs() < 1e-14, "{deviation}");
    }
}
