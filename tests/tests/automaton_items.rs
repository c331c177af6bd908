//! The self-checking population, on every engine, with items that rest, cross toroidal faces and leave
//! through flat ones.

use std::error::Error;
use xca_core::HostValue;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, PRECISIONS, assert_same_runs};
use xca_tests::suite::lattice::{Lattice, Shape, Terrain};
use xca_tests::suite::traveller::{self, SIDE, Traveller};

/// A neighbourhood, a space, and how the items of two classes move in a step, in quarters of a cell: always
/// within the neighbourhood.
type Journey = (Shape, [usize; 3], [i32; 3], [i32; 3]);

const JOURNEYS: [Journey; 10] = [
    (Shape::VonNeumann, [5, 4, 3], [1, 0, 0], [0, -1, 0]),
    (Shape::VonNeumann, [1, 9, 7], [0, 4, 0], [0, 0, -3]),
    (Shape::Moore, [4, 3, 5], [1, 1, 1], [-1, 0, 1]),
    (Shape::Moore, [7, 3, 3], [-4, 3, 0], [2, 2, -2]),
    (Shape::Moore2D, [7, 3, 1], [1, 1, 0], [0, -1, 0]),
    (Shape::HexagonsCornerUp, [5, 4, 1], [1, 0, 0], [-4, 0, 0]),
    (Shape::HexagonsSideUp, [4, 11, 1], [0, 4, 0], [0, -1, 0]),
    (Shape::Skewed, [6, 3, 5], [8, -4, 0], [-4, 0, 4]),
    (Shape::Paired, [5, 4, 3], [2, -1, 3], [0, 4, -1]),
    (Shape::WideMoore, [6, 5, 5], [7, 0, -1], [-1, 8, 3]),
];

/// The largest radius for the items of these spaces, in quarters of a cell. Crosses and hexagons lack cells
/// that touch at a corner.
fn covered(shape: Shape) -> i32 {
    match shape {
        Shape::Moore | Shape::Moore2D | Shape::Paired => 4,
        Shape::WideMoore => 8,
        _ => 0,
    }
}

/// As far as the neighbourhood covers; further than a cell where that is nothing.
fn long_sight(shape: Shape) -> i32 {
    match covered(shape) {
        0 => 5,
        quarters => quarters,
    }
}

fn journey(
    (shape, extents, [x, y, z], [back_x, back_y, back_z]): Journey,
    combination: usize,
    quarters: i32,
    density: u32,
) -> Result<Model, ModelError> {
    let boundaries =
        [0, 1, 2].map(|axis| if combination >> axis & 1 == 1 { Boundary::Toroidal } else { Boundary::Flat });
    let p = Lattice {
        forward: Vector3::new(x, y, z),
        backward: Vector3::new(back_x, back_y, back_z),
        quarters,
        density,
        radius: 0.25 * SIDE * f64::from(quarters),
        covered: u32::from(quarters <= covered(shape)),
        ..Lattice::new(shape, boundaries.into())
    };
    traveller::model(shape, extents, boundaries, p)
}

#[test]
fn every_item_sees_what_it_must() -> Result<(), Box<dyn Error>> {
    let engines = engines::all()?;
    let mut cases = 0;
    for (number, from) in JOURNEYS.into_iter().enumerate() {
        for combination in 0..8 {
            // Many items and short sight, few items and long sight.
            for (quarters, density) in [(3, 12), (long_sight(from.0), 2)] {
                let Ok(model) = journey(from, combination, quarters, density) else {
                    // The one space that is thinner than a torus needs.
                    assert!(number == 1 && combination % 2 == 1);
                    continue;
                };
                for precision in PRECISIONS {
                    cases += 1;
                    let engines = engines::for_case(&engines, cases, engines::SMALL_GPU_SHARE);
                    assert_same_runs(&model, engines, RunOptions { precision, seed: 0 }, 10)
                        .map_err(|error| format!("{}: {error}", model.name()))?;
                }
            }
        }
    }
    Ok(())
}

/// Changes one value of one item between the processes of the second step; every engine must report the same
/// item.
fn assert_found<V: HostValue>(
    substate: Substate<Traveller, V>,
    before: usize,
    change: impl Fn(V) -> V,
) -> Result<(), Box<dyn Error>> {
    let model = journey(JOURNEYS[2], 5, 3, 12)?;
    engines::assert_found(&model, before, &substate, |state| {
        let mut values = state.read(substate)?;
        let middle = values.len() / 2;
        values[middle] = change(values[middle]);
        Ok(state.write(substate, &values)?)
    })
}

/// The population itself is tested: it notices a wrong value in any substate.
#[test]
fn every_change_is_found() -> Result<(), Box<dyn Error>> {
    assert_found(Traveller::POSITION, 0, |at| Vector3::new(at.x + SIDE, at.y, at.z))?;
    assert_found(Traveller::POSITION, 1, |at| Vector3::new(at.x, at.y, at.z - 2.0 * SIDE))?;
    assert_found(Traveller::HOME, 0, |home| Vector3::new(home.x, home.y + 1, home.z))?;
    assert_found(Traveller::CLASS, 0, |class| (class + 1) % 3)?;
    assert_found(Traveller::STAMP, 0, |stamp| stamp ^ 1)?;
    assert_found(Traveller::STAMP, 1, |stamp| stamp ^ 1)?;
    assert_found(Traveller::AWAKE, 1, |awake| [awake[0], !awake[1]])?;
    assert_found(Traveller::TERRAIN, 1, |terrain| {
        if terrain == Terrain::Water { Terrain::Rock } else { Terrain::Water }
    })?;
    assert_found(Traveller::WEIGHT, 0, |weight| weight + 1.0)
}

/// A wrong number of items, too.
#[test]
fn every_loss_is_found() -> Result<(), Box<dyn Error>> {
    let model = journey(JOURNEYS[2], 5, 3, 12)?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        let mut items = simulation.state().items::<Traveller>()?;
        items.pop();
        simulation.state().set_items(items)?;
        assert!(simulation.step().is_err(), "{}", engines::describe(&*engine));
    }
    Ok(())
}
