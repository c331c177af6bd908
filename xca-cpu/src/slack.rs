//! How far items are outside their cells: what a search has to add to its radius.

use crate::blocks::blocks;
use crate::layout::Layout;
use crate::population::Population;
use rayon::prelude::*;
use xca_core::{Geometry, StoredScalar};

/// The largest distance along an axis, in metres, by which an item of the population is outside its cell; NaN where a position is no
/// number. `field` is the position.
pub(crate) fn slack(population: &Population, field: usize, layout: &Layout, geometry: &Geometry) -> f64 {
    let bytes = population.items.fields[field].bytes();
    let blocks = blocks(layout, &[population], rayon::current_num_threads()).into_par_iter().with_max_len(1);
    let of_rows = |row: &(dyn Fn(usize) -> f64 + Sync)| {
        blocks.map(|rows| rows.map(row).fold(0.0, largest)).reduce(|| 0.0, largest)
    };
    match population.types[field].scalar {
        StoredScalar::F32 => {
            let positions: &[[f32; 3]] = bytemuck::cast_slice(bytes);
            of_rows(&|row| of_row(population, layout, geometry, row, |item| positions[item].map(f64::from)))
        }
        _ => {
            let positions: &[[f64; 3]] = bytemuck::cast_slice(bytes);
            of_rows(&|row| of_row(population, layout, geometry, row, |item| positions[item]))
        }
    }
}

fn of_row(
    population: &Population,
    layout: &Layout,
    geometry: &Geometry,
    row: usize,
    position: impl Fn(usize) -> [f64; 3],
) -> f64 {
    let (first, end) = population.row(row);
    if first == end {
        return 0.0;
    }
    let [y, z] = layout.row(row);
    let padded = layout.first(row);
    let side = geometry.side();
    let mut slack = 0.0;
    for x in 0..layout.width() {
        let low = [x, y, z].map(|index| index as f64 * side);
        let high = low.map(|low| low + side);
        for item in population.starts[padded + x]..population.ends[padded + x] {
            let position = position(item as usize);
            for axis in 0..3 {
                // Written so that NaN, too, is not inside; nearly every item is, and a branch that is not taken costs little.
                if !(position[axis] >= low[axis] - slack && position[axis] <= high[axis] + slack) {
                    slack = largest(slack, low[axis] - position[axis]);
                    slack = largest(slack, position[axis] - high[axis]);
                }
            }
        }
    }
    slack
}

/// The larger one, or NaN where one of them is.
pub(crate) fn largest(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::largest;

    #[test]
    fn nan_stays() {
        assert_eq!(largest(1.0, 2.0), 2.0);
        assert_eq!(largest(2.0, 1.0), 2.0);
        assert!(largest(1.0, f64::NAN).is_nan());
        assert!(largest(f64::NAN, 1.0).is_nan());
    }
}
