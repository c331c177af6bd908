//! The self-checking automaton of cells, on every engine, neighbourhood, boundary and many extents.

use std::error::Error;
use xca_core::HostValue;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, assert_same_runs};
use xca_tests::suite::lattice::{Shape, Terrain};
use xca_tests::suite::site::{self, Site};

use Boundary::{Flat, Reflecting, Toroidal};

/// What the two faces of an axis can be: one of each kind, both of a kind, and the torus.
const AXIS: [[Boundary; 2]; 5] =
    [[Flat, Flat], [Toroidal, Toroidal], [Reflecting, Reflecting], [Flat, Reflecting], [Reflecting, Flat]];

/// The faces by the number of the pair of faces across each axis.
fn faces(pairs: [usize; 3]) -> Faces<Boundary> {
    let [[west, east], [south, north], [bottom, top]] = pairs.map(|number| AXIS[number]);
    Faces { west, east, south, north, bottom, top }
}

/// Spaces with few cells: thin along one axis, not square, one layer, as small as the neighbourhood allows,
/// and one with many rows.
fn spaces(shape: Shape) -> &'static [[usize; 3]] {
    match shape {
        Shape::Alone => &[[1, 1, 1], [5, 1, 3]],
        Shape::VonNeumann => &[[3, 3, 3], [1, 4, 5], [9, 2, 1], [4, 3, 6], [2, 11, 10]],
        Shape::Moore | Shape::Paired => &[[3, 3, 3], [1, 1, 1], [5, 1, 4], [7, 4, 3]],
        Shape::VonNeumann2D => &[[1, 5, 1], [6, 4, 1], [3, 5, 2]],
        Shape::Moore2D => &[[5, 1, 1], [6, 4, 1], [3, 3, 2]],
        Shape::WideVonNeumann => &[[5, 5, 5], [2, 6, 3]],
        Shape::WideMoore => &[[5, 5, 5], [3, 2, 6]],
        Shape::HexagonsCornerUp | Shape::HexagonsSideUp => &[[6, 4, 1], [3, 4, 1], [4, 3, 2], [1, 1, 1]],
        Shape::Skewed => &[[5, 3, 5], [2, 1, 2], [6, 4, 5]],
    }
}

/// Whether a model can be built of this: round a torus no cell may be its own neighbour, beyond other faces
/// there is only one more space, and rows of hexagons alternate.
fn fits(shape: Shape, extents: [usize; 3], boundaries: Faces<Boundary>) -> bool {
    let alternating = match shape {
        Shape::HexagonsCornerUp => Some(1),
        Shape::HexagonsSideUp => Some(0),
        _ => None,
    };
    Face::ALL.into_iter().all(|face| {
        let axis = face.axis();
        let (reach, extent) = (shape.reach()[axis], extents[axis]);
        match boundaries[face] {
            Flat => reach <= extent,
            Toroidal => (reach == 0 || extent > 2 * reach) && (alternating != Some(axis) || extent % 2 == 0),
            Reflecting => reach <= extent && alternating != Some(axis),
        }
    })
}

#[test]
fn every_cell_finds_what_it_must_in_f32() -> Result<(), Box<dyn Error>> {
    every_cell_finds_what_it_must(Precision::F32)
}

#[test]
fn every_cell_finds_what_it_must_in_f64() -> Result<(), Box<dyn Error>> {
    every_cell_finds_what_it_must(Precision::F64)
}

fn every_cell_finds_what_it_must(precision: Precision) -> Result<(), Box<dyn Error>> {
    let engines = engines::all()?;
    let mut cases = 0;
    for (number, shape) in Shape::ALL.into_iter().enumerate() {
        for (space, &extents) in spaces(shape).iter().enumerate() {
            for combination in 0..125 {
                let pairs = [combination % 5, combination / 5 % 5, combination / 25];
                // Axes with two kinds of faces take turns with the spaces; all of them come with each shape
                // or the next ones.
                if pairs.iter().any(|pair| *pair > 2) && (combination + number + space) % 4 != 0 {
                    continue;
                }
                let boundaries = faces(pairs);
                let model = site::model(shape, extents, boundaries);
                assert_eq!(
                    model.is_ok(),
                    fits(shape, extents, boundaries),
                    "{shape:?} {extents:?} {boundaries}"
                );
                let Ok(model) = model else { continue };
                cases += 1;
                let engines = engines::for_case(&engines, cases, engines::SMALL_GPU_SHARE);
                assert_same_runs(&model, engines, RunOptions { precision, seed: 0 }, 3)
                    .map_err(|error| format!("{}: {error}", model.name()))?;
            }
        }
    }
    Ok(())
}

/// Changes one value between the processes of the second step; every engine must report the same cell.
fn assert_found<V: HostValue>(
    substate: Substate<Site, V>,
    before: usize,
    change: impl Fn(V) -> V,
) -> Result<(), Box<dyn Error>> {
    let model = site::model(Shape::VonNeumann, [4, 3, 5], [Toroidal, Flat, Reflecting])?;
    engines::assert_found(&model, before, &substate, |state| {
        let cell = [3, 1, 4];
        let value = state.get(substate, cell)?;
        Ok(state.set(substate, cell, change(value))?)
    })
}

/// The automaton itself is tested: it notices a wrong value in any substate.
#[test]
fn every_change_is_found() -> Result<(), Box<dyn Error>> {
    assert_found(Site::PLACE, 0, |place| Vector3::new(place.y, place.x, place.z))?;
    assert_found(Site::STAMP, 0, |stamp| stamp ^ 0x8000_0000)?;
    assert_found(Site::STAMP, 2, |stamp| stamp ^ 1)?;
    assert_found(Site::TAG, 0, |tag| tag ^ 1)?;
    assert_found(Site::COUNT, 0, |count| count ^ 1)?;
    assert_found(Site::COUNT, 3, |count| count ^ 1)?;
    assert_found(Site::SINGLE, 0, |single| single + 0.25)?;
    assert_found(Site::DOUBLE, 1, |double| double + 0.125)?;
    assert_found(Site::LEVEL, 2, |level| -level)?;
    assert_found(Site::FLOW, 2, |flow| Vector3::new(flow.x, flow.y, flow.z + 1.0))?;
    assert_found(Site::PAIR, 4, |pair| Vector2::new(pair.x + 0.25, pair.y))?;
    assert_found(Site::TABLE, 0, |table| [table[0], table[1], table[2] ^ 1, table[3]])?;
    assert_found(Site::PATHS, 2, |paths| [paths[0], Vector2::new(paths[1].x + 0.5, paths[1].y)])?;
    assert_found(
        Site::TERRAIN,
        3,
        |terrain| if terrain == Terrain::Soil { Terrain::Rock } else { Terrain::Soil },
    )?;
    assert_found(
        Site::TERRAIN,
        0,
        |terrain| if terrain == Terrain::Soil { Terrain::Rock } else { Terrain::Soil },
    )?;
    assert_found(Site::WET, 3, |wet| [wet[0], !wet[1]])?;
    assert_found(Site::DRY, 2, |dry| !dry)?;
    assert_found(Site::TERRAINS, 1, |mut terrains| {
        terrains[8] = Terrain::Water;
        terrains
    })?;
    assert_found(Site::STEPS, 0, |steps| Vector4::new(steps.x, 0, 0, steps.w + 1))
}
