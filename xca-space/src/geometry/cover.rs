//! The largest radius of a search that finds every item.

use crate::neighbourhood::Neighbourhood;
use std::collections::HashSet;

/// What the radius depends on.
#[derive(Clone, Copy)]
pub(super) struct Covering<'a> {
    /// The number of cells along x, y, z, before the model has checked it.
    pub(super) extents: [usize; 3],
    /// Whether the axes x, y, z are toroidal.
    pub(super) toroidal: [bool; 3],
    pub(super) neighbourhood: &'a Neighbourhood,
}

/// The distance from a cell to the nearest cell of the space that is not in its neighbourhood, in sides of a
/// cell. Infinite if the neighbourhood holds the whole space.
///
/// Cells are closed boxes, so touching cells have distance 0. A displacement counts if it leads from some
/// cell to a cell of the space. It does not cross the flat faces of a thin space, and takes the shorter way
/// on a torus. With hexagons, the rows or columns that see less decide.
pub(super) fn covered(covering: Covering<'_>) -> f64 {
    let alternating = [[0; 3], [1, 1, 0]];
    alternating.map(|cell| covered_from(covering, cell)).into_iter().fold(f64::INFINITY, f64::min)
}

fn covered_from(covering: Covering<'_>, cell: [usize; 3]) -> f64 {
    let displacements = covering.neighbourhood.displacements(cell);
    let held: HashSet<[i32; 3]> =
        displacements.iter().map(|at| [0, 1, 2].map(|axis| canonical(covering, axis, at[axis]))).collect();
    // The displacements along an axis that lead to cells of the space, up to one cell beyond the reach. Cells
    // farther away are also missing, but are not nearer.
    let steps = |axis: usize| {
        let extent = extent(covering, axis);
        let (low, high) =
            if covering.toroidal[axis] { ((extent - 1) / 2, extent / 2) } else { (extent - 1, extent - 1) };
        let reach = covering.neighbourhood.reach()[axis] as i64 + 1;
        -low.min(reach)..=high.min(reach)
    };
    let [along_x, along_y, along_z] = [0, 1, 2].map(steps);
    let furthest = [&along_x, &along_y, &along_z]
        .into_iter()
        .map(|along| (-along.start()).max(*along.end()))
        .max()
        .unwrap_or(0);
    let mut least = i64::MAX;
    // By shell: the cells of a shell are at least (its number - 1) away.
    for shell in 1..=furthest {
        if (shell - 1) * (shell - 1) >= least {
            break;
        }
        let within =
            |along: &std::ops::RangeInclusive<i64>| (*along.start()).max(-shell)..=(*along.end()).min(shell);
        for z in within(&along_z) {
            for y in within(&along_y) {
                for x in within(&along_x) {
                    let of_shell = [x, y, z].iter().any(|step| step.abs() == shell);
                    if of_shell && !held.contains(&[x as i32, y as i32, z as i32]) {
                        let gaps = [x, y, z].map(|step| (step.abs() - 1).max(0));
                        least = least.min(gaps.iter().map(|gap| gap * gap).sum());
                    }
                }
            }
        }
    }
    if least == i64::MAX { f64::INFINITY } else { (least as f64).sqrt() }
}

/// The number of cells along an axis, before the model has checked it.
fn extent(covering: Covering<'_>, axis: usize) -> i64 {
    i64::try_from(covering.extents[axis]).unwrap_or(i64::MAX)
}

/// The shorter of the displacements that lead to the same cell.
fn canonical(covering: Covering<'_>, axis: usize, step: i32) -> i32 {
    let extent = extent(covering, axis);
    if !covering.toroidal[axis] || extent == 0 {
        return step;
    }
    let low = (extent - 1) / 2;
    ((i64::from(step) + low).rem_euclid(extent) - low) as i32
}

#[cfg(test)]
mod tests {
    use crate::geometry::{Boundary, Faces, Geometry};
    use crate::neighbourhood::{Hexagons, Neighbourhood};
    use xca_values::Precision;

    fn covered(extents: [usize; 3], boundary: Boundary, neighbourhood: Neighbourhood) -> f64 {
        Geometry::new(extents, 0.5, Faces::all(boundary), neighbourhood).covered_radius(Precision::F64)
    }

    #[test]
    fn cubes_cover_their_radius() {
        for radius in 0..3 {
            let cube = covered([9; 3], Boundary::Flat, Neighbourhood::moore(radius));
            assert_eq!(cube, 0.5 * f64::from(radius));
        }
        // A single layer has no missing cells above and below, a deep space has.
        let layer = |extents, boundary| covered(extents, boundary, Neighbourhood::moore_2d(1));
        assert_eq!(layer([9, 9, 1], Boundary::Flat), 0.5);
        assert_eq!(layer([9, 9, 1], Boundary::Toroidal), 0.5);
        assert_eq!(layer([9, 9, 2], Boundary::Flat), 0.0);
    }

    /// Corners decide: a cell that touches at a corner has distance 0.
    #[test]
    fn crosses_cover_less() {
        let cross = |radius| covered([9; 3], Boundary::Flat, Neighbourhood::von_neumann(radius));
        assert_eq!([1, 2, 3, 4].map(cross), [0.0, 0.0, 0.5, 0.5 * 2_f64.sqrt()]);
        let flat = |radius| covered([9, 9, 1], Boundary::Flat, Neighbourhood::von_neumann_2d(radius));
        assert_eq!([1, 2, 3, 4].map(flat), [0.0, 0.5, 0.5 * 2_f64.sqrt(), 0.5 * 5_f64.sqrt()]);
        for hexagons in [Hexagons::CornerUp, Hexagons::SideUp] {
            assert_eq!(covered([8, 8, 1], Boundary::Flat, Neighbourhood::hexagonal(hexagons)), 0.0);
        }
    }

    #[test]
    fn a_space_that_is_held_as_a_whole_has_no_limit() {
        let seven = || Neighbourhood::von_neumann(1);
        assert_eq!(covered([2, 1, 1], Boundary::Flat, seven()), f64::INFINITY);
        assert_eq!(covered([3, 1, 1], Boundary::Flat, seven()), 0.5);
        assert_eq!(covered([3; 3], Boundary::Toroidal, Neighbourhood::moore(1)), f64::INFINITY);
        assert_eq!(covered([4; 3], Boundary::Toroidal, Neighbourhood::moore(1)), 0.5);
    }

    /// A list with a hole covers the distance to the hole.
    #[test]
    fn holes_count() {
        let mut displacements: Vec<[i32; 3]> = Neighbourhood::moore_2d(2).displacements([0; 3]).to_vec();
        displacements.retain(|at| *at != [2, 0, 0]);
        let holed = Neighbourhood::custom(displacements.clone()).unwrap();
        assert_eq!(covered([9, 9, 1], Boundary::Flat, holed), 0.5);
        displacements.retain(|at| *at != [1, 1, 0]);
        let holed = Neighbourhood::custom(displacements).unwrap();
        assert_eq!(covered([9, 9, 1], Boundary::Flat, holed), 0.0);
    }
}
