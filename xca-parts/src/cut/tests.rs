use super::Cut;
use crate::grid::Grid;
use xca_core::{Boundary, Face, Faces, Geometry, Neighbourhood};

fn space(extents: [usize; 3], reach: u8) -> Geometry {
    Geometry::new(extents, 1.0, Faces::all(Boundary::Flat), Neighbourhood::moore(reach))
}

/// Work that is anything but even.
fn work(geometry: &Geometry, seed: u64) -> Vec<u64> {
    let [_, height, depth] = geometry.extents();
    let of_row = |row: usize| (row as u64 + 3).wrapping_mul(0x9e37_79b9_7f4a_7c15 ^ seed) >> 40;
    (0..height * depth).map(|row| if row as u64 % 5 < seed % 4 { 0 } else { of_row(row) }).collect()
}

/// Even cuts, and some that follow work.
fn cuts() -> Vec<(Geometry, Cut)> {
    let mut all = Vec::new();
    for (height, depth, y, z) in [(7, 5, 3, 2), (13, 1, 5, 1), (4, 9, 4, 4), (6, 6, 1, 6), (7, 9, 3, 4)] {
        let (geometry, grid) = (space([2, height, depth], 1), Grid { y, z });
        all.push((geometry.clone(), Cut::even(&geometry, grid)));
        for seed in 1..9 {
            all.push((geometry.clone(), Cut::balanced(&geometry, grid, &work(&geometry, seed))));
        }
    }
    all
}

/// Each row belongs to one part, which knows it.
#[test]
fn each_row_has_one_part() {
    for (geometry, cut) in cuts() {
        let [_, height, depth] = geometry.extents();
        let mut owners = vec![None; height * depth];
        for number in 0..cut.count() {
            for row in cut.part(number).runs(&geometry).flatten() {
                assert_eq!(owners[row].replace(number), None, "{cut:?}");
            }
        }
        for (row, owner) in owners.into_iter().enumerate() {
            assert_eq!(owner, Some(cut.part_of([row % height, row / height])), "{cut:?}");
        }
    }
}

/// The part beyond a face has this part beyond its opposite face. One row farther is the next part.
#[test]
fn parts_lie_beyond_each_other() {
    for (geometry, cut) in cuts() {
        let [_, height, depth] = geometry.extents();
        for number in 0..cut.count() {
            let part = cut.part(number);
            let at = |y: usize, z: usize| cut.part_of([y % height, z % depth]);
            let wanted = Faces {
                west: number,
                east: number,
                south: at(part.y.start + height - 1, part.z.start),
                north: at(part.y.end, part.z.start),
                bottom: at(part.y.start, part.z.start + depth - 1),
                top: at(part.y.start, part.z.end),
            };
            for face in Face::ALL {
                assert_eq!(cut.beyond(number, face), wanted[face], "{cut:?}");
                assert_eq!(cut.beyond(wanted[face], face.opposite()), number);
            }
        }
    }
}

/// A part is as thick as the model reaches, wherever the work is.
#[test]
fn parts_can_see_no_further_than_the_next() {
    let geometry = space([2, 13, 12], 3);
    for grid in [Grid { y: 4, z: 1 }, Grid { y: 1, z: 4 }, Grid { y: 4, z: 4 }, Grid { y: 2, z: 3 }] {
        for seed in 0..9 {
            let mut work = work(&geometry, seed);
            // All of it in one row, or nearly.
            work[seed as usize * 17] += 1 << 40;
            let cut = Cut::balanced(&geometry, grid, &work);
            (0..cut.count()).try_for_each(|number| cut.part(number).check(&geometry)).unwrap();
            assert_eq!(cut.grid(), grid);
        }
    }
}

/// Along both axes no bound can be moved to make the largest work smaller, and it is never more than that of
/// the even cut.
#[test]
fn work_along_both_axes_is_shared() {
    let (geometry, grid) = (space([2, 16, 16], 1), Grid { y: 4, z: 4 });
    let largest = |cut: &Cut, work: &[u64]| cut.work_of_parts(&geometry, work).into_iter().max().unwrap();
    // A square of four by four rows with work, in a corner.
    let corner: Vec<u64> = (0..256).map(|row| u64::from(row % 16 < 4 && row / 16 >= 12) * 1000).collect();
    let cut = Cut::balanced(&geometry, grid, &corner);
    assert_eq!((largest(&Cut::even(&geometry, grid), &corner), largest(&cut, &corner)), (16_000, 1000));
    for seed in 0..20 {
        let work = work(&geometry, seed);
        let cut = Cut::balanced(&geometry, grid, &work);
        assert!(largest(&cut, &work) <= largest(&Cut::even(&geometry, grid), &work) * 65 / 64);
    }
}

/// Without work the cut is even.
#[test]
fn rows_without_work_are_shared_evenly() {
    let (geometry, grid) = (space([2, 12, 8], 1), Grid { y: 3, z: 2 });
    assert_eq!(Cut::balanced(&geometry, grid, &[0; 96]), Cut::even(&geometry, grid));
}
