use super::{ALIGNMENT, Geometry, HaloCell, Part, Shown, Space, TooLarge};
use xca_core::{Boundary, Face, Faces, Model, Neighbourhood, Reached, Substates};

#[derive(Substates, Clone, Copy)]
struct Grey {
    level: u8,
}

fn geometry(extents: [usize; 3], neighbourhood: Neighbourhood) -> Geometry {
    bounded(extents, neighbourhood, Faces::all(Boundary::Toroidal))
}

fn bounded(extents: [usize; 3], neighbourhood: Neighbourhood, boundaries: Faces<Boundary>) -> Geometry {
    let model = Model::builder("grey")
        .extents(extents)
        .neighbourhood(neighbourhood)
        .boundaries(boundaries)
        .substates::<Grey>()
        .build();
    model.unwrap().geometry().clone()
}

fn whole(geometry: &Geometry, reachable: u64) -> Result<Space, TooLarge> {
    Space::new(geometry, &Part::whole(geometry), reachable)
}

#[test]
fn what_fits_is_one_part() {
    let space = whole(&geometry([5, 4, 3], Neighbourhood::moore(1)), 7 * 6 * 5).unwrap();
    assert_eq!(space.sections().len(), 1);
    assert_eq!((space.row(), space.layer(), space.stored()), (7, 42, 210));
}

/// Each cell lies in one section, with all its neighbours in what is stored of the section.
#[test]
fn parts_hold_their_cells_with_their_neighbours() {
    for (extents, neighbourhood, reachable) in [
        ([5, 4, 9], Neighbourhood::moore(1), 300),
        ([5, 5, 9], Neighbourhood::von_neumann(2), 800),
        ([70, 30, 1], Neighbourhood::moore_2d(1), 600),
    ] {
        let geometry = geometry(extents, neighbourhood);
        let space = whole(&geometry, reachable).unwrap();
        assert!(space.sections().len() > 1);
        let mut seen = 0;
        for linear in 0..geometry.cells() {
            let cell = geometry.indices(linear);
            let section = space.section_of(cell).unwrap();
            assert!((0..3).all(|axis| cell[axis] >= section.first[axis]));
            seen += 1;
            let number = space.number(cell);
            assert_eq!(space.cell(number), cell);
            for offset in space.offsets() {
                let there = (number as i64 + i64::from(offset)) as usize;
                assert!((section.base..section.base + section.stored).contains(&there));
            }
        }
        assert_eq!(
            seen,
            space.sections().iter().map(|section| section.count.iter().product::<usize>()).sum::<usize>()
        );
        for section in space.sections() {
            assert!(section.stored as u64 <= reachable && section.base + section.stored <= space.stored());
            assert_eq!(section.base % ALIGNMENT, 0);
        }
    }
}

#[test]
fn what_cannot_be_cut_is_refused() {
    let geometry = geometry([50, 40, 9], Neighbourhood::moore(1));
    assert_eq!(whole(&geometry, 2000).unwrap_err(), TooLarge { wanted: 3 * 2240 });
}
/// The values that messages and boundary rules bring into the halos of parts are those that the whole
/// space has there, for each cell its number.
#[test]
fn halos_of_parts_show_the_whole_space() {
    use Boundary::{Flat, Reflecting, Toroidal};
    let neighbourhood = Neighbourhood::moore(1);
    for boundaries in [
        Faces::all(Flat),
        Faces::all(Toroidal),
        Faces::from([Reflecting, Toroidal, Flat]),
        Faces { south: Reflecting, top: Reflecting, ..Faces::all(Flat) },
    ] {
        let geometry = bounded([3, 6, 4], neighbourhood.clone(), boundaries);
        for parts in [[3, 1], [1, 2], [2, 2]] {
            check_halos(&geometry, parts);
        }
    }
}

fn check_halos(geometry: &Geometry, [parts_y, parts_z]: [usize; 2]) {
    const OUTSIDE: usize = 1000;
    const NOTHING: usize = usize::MAX;
    let outside = |face: Face| OUTSIDE + Face::ALL.iter().position(|other| *other == face).unwrap();
    let [_, height, depth] = geometry.extents();
    let rows = |all: usize, parts: usize, at: usize| at * all / parts..(at + 1) * all / parts;
    let at = |y, z| Part { y: rows(height, parts_y, y), z: rows(depth, parts_z, z) };
    let parts: Vec<Part> = (0..parts_z).flat_map(|z| (0..parts_y).map(move |y| at(y, z))).collect();
    let spaces: Vec<Space> = parts.iter().map(|part| Space::new(geometry, part, 1000).unwrap()).collect();
    let mut values: Vec<Vec<usize>> = spaces
        .iter()
        .map(|space| {
            let mut values = vec![NOTHING; space.stored()];
            let own = (0..geometry.cells()).filter(|cell| space.part().holds(geometry, *cell));
            own.for_each(|cell| values[space.number(geometry.indices(cell))] = cell);
            for HaloCell { number, shows } in space.halo() {
                match shows {
                    Shown::Cell(source) => values[number] = values[source],
                    Shown::Outside(face) => values[number] = outside(face),
                    Shown::Elsewhere => {}
                }
            }
            values
        })
        .collect();
    for face in [Face::South, Face::North, Face::Bottom, Face::Top] {
        let before = values.clone();
        for (number, space) in spaces.iter().enumerate() {
            if !space.part().borders(geometry)[face] {
                continue;
            }
            let (y, z) = (number % parts_y, number / parts_y);
            let next = |at: usize, parts: usize, axis: usize| match face.axis() == axis {
                false => at,
                true if face == Face::ALONG[axis][0] => (at + parts - 1) % parts,
                true => (at + 1) % parts,
            };
            let beyond = next(z, parts_z, 2) * parts_y + next(y, parts_y, 1);
            let [_, seen] = space.edges(face);
            let [sent, _] = spaces[beyond].edges(face.opposite());
            assert_eq!(sent.len(), seen.len());
            for (from, to) in sent.into_iter().zip(seen) {
                values[number][to] = before[beyond][from];
            }
        }
    }
    for (space, values) in spaces.iter().zip(&values) {
        for cell in (0..geometry.cells()).filter(|cell| space.part().holds(geometry, *cell)) {
            let cell = geometry.indices(cell);
            let offsets = space.offsets();
            let displacements = geometry.neighbourhood().displacements(cell);
            for (displacement, offset) in displacements.iter().zip(offsets) {
                let wanted = match geometry.reach(cell, *displacement) {
                    Reached::Cell(there) => geometry.linear(there),
                    Reached::Outside(face) => outside(face),
                };
                let there = (space.number(cell) as i64 + i64::from(offset)) as usize;
                assert_eq!(values[there], wanted, "{:?} {cell:?} {displacement:?}", space.part());
            }
        }
    }
}
