//! The ground below a layer of cells, lit by a low sun in the north-west.

/// Heights to draw a layer of cells over.
#[derive(Debug, Clone, Copy)]
pub struct Relief<'a> {
    /// The height of the ground in each cell, in the unit of the cell's side, in the order of the values. NaN
    /// without ground.
    pub heights: &'a [f64],
    /// The bare ground shows where the drawn value is at most this.
    pub bare: f64,
}

/// Linear RGB of the bare ground at right angles to the sun.
const GROUND: [f32; 3] = [0.86, 0.82, 0.74];
/// The direction of the sun: to the west, to the north, and up. Of length 1.
const SUN: [f64; 3] = [-0.5, 0.5, std::f64::consts::FRAC_1_SQRT_2];
/// The light from all directions.
const SKY: f64 = 0.25;
/// Slopes are exaggerated up to this root mean square.
const SLOPE: f64 = 0.5;

/// The lightness of the ground in each cell.
#[derive(Debug)]
pub(super) struct Ground {
    lightness: Vec<f32>,
    bare: f64,
}

impl Ground {
    /// `relief` must have one height for each cell.
    pub(super) fn new(relief: Relief<'_>, [columns, rows]: [usize; 2], side: f64) -> Self {
        let height = |x: usize, y: usize| relief.heights[y * columns + x];
        // The ground is level towards a border, and towards cells without a height.
        let slope = |low: f64, high: f64, cells: usize| {
            let slope = (high - low) / (cells.max(1) as f64 * side);
            if slope.is_finite() { slope } else { 0.0 }
        };
        let slopes: Vec<[f64; 2]> = (0..columns * rows)
            .map(|cell| {
                let (x, y) = (cell % columns, cell / columns);
                let [west, east] = [x.saturating_sub(1), (x + 1).min(columns - 1)];
                let [south, north] = [y.saturating_sub(1), (y + 1).min(rows - 1)];
                let across = slope(height(west, y), height(east, y), east - west);
                [across, slope(height(x, south), height(x, north), north - south)]
            })
            .collect();
        let squares: f64 = slopes.iter().flatten().map(|slope| slope * slope).sum();
        // Cells without ground do not change the exaggeration.
        let count = relief.heights.iter().filter(|height| height.is_finite()).count();
        let mean = (squares / count.max(1) as f64).sqrt();
        let factor = if mean > 0.0 { (SLOPE / mean).max(1.0) } else { 1.0 };
        let lightness = |[across, along]: &[f64; 2]| {
            let normal = [-across * factor, -along * factor, 1.0];
            let length = normal.iter().map(|lane| lane * lane).sum::<f64>().sqrt();
            let of_sun = normal.iter().zip(SUN).map(|(lane, sun)| lane * sun).sum::<f64>() / length;
            (SKY + (1.0 - SKY) * of_sun.max(0.0)) as f32
        };
        Self { lightness: slopes.iter().map(lightness).collect(), bare: relief.bare }
    }

    /// The colour of a cell with this value, where `own` is its colour without ground.
    pub(super) fn colour(&self, cell: usize, value: f64, own: [f32; 3]) -> [f32; 3] {
        let lightness = self.lightness[cell];
        if value <= self.bare {
            return GROUND.map(|lane| lane * lightness);
        }
        // Half of the shadow only, so that the colour remains recognizable on the scale.
        own.map(|lane| lane * (0.5 + 0.5 * lightness))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ground(heights: &[f64], columns: usize) -> Ground {
        Ground::new(Relief { heights, bare: 0.5 }, [columns, heights.len() / columns], 2.0)
    }

    #[test]
    fn slopes_to_the_north_west_are_the_lightest() {
        // A tent whose ridge runs from the south-west to the north-east.
        let heights: Vec<f64> = (0..25_i32).map(|cell| f64::from(-(cell % 5 - cell / 5).abs())).collect();
        let tent = ground(&heights, 5);
        let [north_west, south_east] = [tent.lightness[16], tent.lightness[8]];
        let level = ground(&[3.0; 25], 5).lightness[12];
        assert!(north_west > level && level > south_east, "{north_west} {level} {south_east}");
        assert!((level - 0.78).abs() < 0.01, "{level}");
        // In the mirror image, the sides change places.
        let hole: Vec<f64> = heights.iter().map(|height| -height).collect();
        assert!(ground(&hole, 5).lightness[16] < level);
    }

    #[test]
    fn gentle_slopes_are_seen_and_what_has_no_height_is_level() {
        let of =
            |steepness: f64| -> Vec<f64> { (0..9).map(|cell| f64::from(cell % 3) * steepness).collect() };
        let [gentle, gentler] = [1e-3, 1e-6].map(|steepness| ground(&of(steepness), 3).lightness[4]);
        assert_eq!(gentle, gentler);
        assert!(gentle > 0.85, "it rises to the east, and faces the sun: {gentle}");
        let mut heights = of(0.0);
        heights[0] = f64::NAN;
        assert!(ground(&heights, 3).lightness.iter().all(|lightness| (lightness - 0.78).abs() < 0.01));
    }

    #[test]
    fn cells_without_ground_do_not_change_how_steep_the_others_look() {
        let steepness = |x: i32| f64::from(x) * 1e-3;
        let whole: Vec<f64> = (0..9).map(|cell| steepness(cell % 3)).collect();
        // The same ground beside six columns without ground. The last column with ground is then level.
        let wide: Vec<f64> =
            (0..27).map(|cell| if cell % 9 < 3 { steepness(cell % 9) } else { f64::NAN }).collect();
        let (whole, wide) = (ground(&whole, 3).lightness[4], ground(&wide, 9).lightness[10]);
        assert!((whole - wide).abs() < 0.02, "{whole} {wide}");
    }

    #[test]
    fn what_is_little_shows_the_ground() {
        let level = ground(&[0.0], 1);
        let own = [0.1, 0.2, 0.9];
        assert_eq!(level.colour(0, 0.5, own), GROUND.map(|lane| lane * level.lightness[0]));
        let blue = level.colour(0, 0.6, own);
        assert!(blue[2] > 0.7 && blue[0] < 0.1);
        assert_ne!(level.colour(0, f64::NAN, own), level.colour(0, 0.0, own));
    }
}
