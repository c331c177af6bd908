use super::Layout;
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Site {
    value: u32,
}

fn layouts() -> Vec<Layout> {
    const FLAT: Boundary = Boundary::Flat;
    const RING: Boundary = Boundary::Toroidal;
    const MIRROR: Boundary = Boundary::Reflecting;
    let spaces = [
        ([5, 7, 6], Neighbourhood::moore(1)),
        ([5, 6, 9], Neighbourhood::moore(2)),
        ([5, 9, 1], Neighbourhood::moore_2d(2)),
        ([9, 1, 1], Neighbourhood::custom(vec![[0; 3], [1, 0, 0]]).unwrap()),
        ([5, 5, 8], Neighbourhood::custom(vec![[0; 3], [0, 0, 2]]).unwrap()),
    ];
    let boundaries =
        [[FLAT; 3], [RING; 3], [MIRROR; 3], [FLAT, RING, MIRROR], [RING, MIRROR, FLAT], [MIRROR, FLAT, RING]];
    let of_space = |(extents, neighbourhood): ([usize; 3], Neighbourhood)| {
        boundaries.map(|boundaries| {
            let builder = Model::builder("site").extents(extents).neighbourhood(neighbourhood.clone());
            let model = builder.boundaries(boundaries).substates::<Site>().build().unwrap();
            Layout::new(model.geometry())
        })
    };
    spaces.into_iter().flat_map(of_space).collect()
}

/// The halo filled by the boundary rules is the reference.
#[test]
fn images_of_a_row_are_the_lines_of_the_halo_that_show_it() {
    for layout in layouts() {
        let mut plane = vec![usize::MAX; layout.cells()];
        for row in 0..layout.rows() {
            let first = layout.first(row);
            plane[first..first + layout.width()].fill(row);
        }
        layout.fill_halo(&mut plane, 1, None, false);
        let [_, along, up] = layout.reach().map(|reach| reach as isize);
        let [_, height, depth] = layout.extents.map(|extent| extent as isize);
        for row in 0..layout.rows() {
            let mut images: Vec<_> = layout.images(row).collect();
            images.sort_unstable_by_key(|[y, z]| (*z, *y));
            let lines = (-up..depth + up).flat_map(|z| (-along..height + along).map(move |y| [y, z]));
            let is_inside = |[y, z]: &[isize; 2]| (0..height).contains(y) && (0..depth).contains(z);
            let shown: Vec<_> = lines
                .filter(|line| !is_inside(line) && plane[layout.cells_of_line(*line).start] == row)
                .collect();
            assert_eq!(images, shown, "{layout:?} {row}");
        }
    }
}

#[test]
fn rows_that_see_each_other_are_no_further_apart_than_the_lag() {
    let mut with_columns = 0;
    for layout in layouts() {
        let lag = layout.lag().unwrap();
        let layers = layout.rows() / lag.layer;
        let (mut most, mut most_along) = (0, 0);
        for row in 0..layout.rows() {
            for other in layout.rows_around(row) {
                let apart = (row / lag.layer).abs_diff(other / lag.layer);
                most = most.max(if lag.is_ring { apart.min(layers - apart) } else { apart });
                most_along = most_along.max((row % lag.layer).abs_diff(other % lag.layer));
            }
        }
        assert_eq!(most, lag.layers, "{layout:?} {lag:?}");
        if let Some(along) = lag.along {
            assert_eq!(most_along, along, "{layout:?} {lag:?}");
            with_columns += 1;
        }
    }
    assert!(with_columns > 8, "{with_columns}");
}
