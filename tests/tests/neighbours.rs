//! Where neighbours lie: named directions, opposites, displacements and existence, on every engine.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::{Draw, Fault, ModelBuilder, Stream};
use xca_tests::suite::engines::{self, PRECISIONS, assert_same_fault, assert_same_runs};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Place {
    number: u32,
    seen: u32,
}

/// The numbers of the cells of a layer of hexagons or squares, from 1.
fn numbered(extents: [usize; 3], neighbourhood: Neighbourhood) -> ModelBuilder {
    let [width, height, _] = extents;
    Model::builder("numbered").extents(extents).neighbourhood(neighbourhood).substates::<Place>().fill(
        move |site| {
            let [x, y, z] = site.cell();
            Place { number: ((z * height + y) * width + x + 1) as u32, seen: 0 }
        },
    )
}

/// What each cell has seen after a step, the same on every engine.
fn seen(builder: ModelBuilder) -> Result<Vec<u32>, Box<dyn Error>> {
    let model = builder.build()?;
    for precision in PRECISIONS {
        assert_same_runs(&model, &engines::all()?, RunOptions { precision, seed: 0 }, 1)?;
    }
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    simulation.step()?;
    Ok(simulation.state().read(Place::SEEN)?)
}

#[elementary_process]
fn look_north_east(cell: &mut Cell<Place>) {
    cell.seen = cell.neighbour(directions::moore_2d::NORTH_EAST).number;
}

#[elementary_process]
fn look_up(cell: &mut Cell<Place>) {
    cell.seen = cell.neighbour(directions::von_neumann::UP).number;
}

#[elementary_process]
fn look_down(cell: &mut Cell<Place>) {
    cell.seen = cell.neighbour(cell.opposite(directions::von_neumann::UP)).number;
}

/// The direction is a constant of the model's own, the loop one over constants.
const FIRST: usize = directions::von_neumann_2d::SOUTH;
const LAST: usize = directions::von_neumann_2d::NORTH;

#[elementary_process]
fn collect(cell: &mut Cell<Place>) {
    let mut seen = 0;
    for n in FIRST..=LAST {
        if cell.exists(n) {
            let back = cell.opposite(n);
            seen = 10 * seen
                + match n {
                    directions::von_neumann_2d::SOUTH => 1,
                    directions::von_neumann_2d::WEST => 2,
                    _ => (back + 1) as u32,
                };
        }
    }
    cell.seen = seen;
}

#[test]
fn directions_have_names() -> Result<(), Box<dyn Error>> {
    let squares = || numbered([3, 2, 1], Neighbourhood::moore_2d(1));
    assert_eq!(seen(squares().process(look_north_east))?, [5, 6, 0, 0, 0, 0]);
    let column = || numbered([1, 1, 3], Neighbourhood::von_neumann(1));
    assert_eq!(seen(column().process(look_up))?, [2, 3, 0]);
    assert_eq!(seen(column().process(look_down))?, [0, 1, 2]);
    // South 1 and west 2; north has 1 in the opposite direction, east 2.
    let cross = numbered([2, 2, 1], Neighbourhood::von_neumann_2d(1));
    assert_eq!(seen(cross.process(collect))?, [32, 22, 13, 12]);
    Ok(())
}

/// Rings of three cells along x and y, so that each direction is a list of its own, in no order.
#[elementary_process]
fn add_opposites(cell: &mut Cell<Place>) {
    let mut seen = 0;
    let mut n = cell.neighbour_count();
    while n > 1 {
        n -= 1;
        seen = 10 * seen + cell.opposite(n) as u32;
    }
    cell.seen = seen;
}

#[test]
fn opposites_of_a_custom_list() -> Result<(), Box<dyn Error>> {
    let list = vec![[0, 0, 0], [1, 0, 0], [0, 2, 0], [-1, 0, 0], [1, -1, 0], [0, -2, 0], [-1, 1, 0]];
    let neighbourhood = Neighbourhood::custom(list)?;
    let model = numbered([3, 4, 1], neighbourhood.clone()).process(add_opposites);
    assert_eq!(seen(model)?, [426_153; 12]);
    assert_eq!([1, 2, 3, 4, 5, 6, 7].map(|n| neighbourhood.opposite(n)), {
        [Some(3), Some(5), Some(1), Some(6), Some(2), Some(4), None]
    });
    Ok(())
}

#[test]
fn a_list_without_an_opposite_is_refused() -> Result<(), Box<dyn Error>> {
    let list = vec![[0, 0, 0], [1, 0, 0], [-1, 0, 0], [1, -1, 0]];
    let refused = |builder: ModelBuilder| builder.build().map_err(|error| error.to_string());
    let neighbourhood = Neighbourhood::custom(list)?;
    let error = refused(numbered([3, 4, 1], neighbourhood.clone()).process(add_opposites));
    assert_eq!(
        error.err().as_deref(),
        Some(
            "the process `add_opposites` uses `opposite`, but the neighbourhood (custom, 4 cells) lacks the displacement [-1, 1, 0], the \
             opposite of [1, -1, 0]; add it to the list"
        )
    );
    // Only where it is used.
    assert!(refused(numbered([3, 4, 1], neighbourhood).process(ask_displacement)).is_ok());
    Ok(())
}

#[elementary_process]
fn ask_opposite(cell: &mut Cell<Place>) {
    if cell.number == 4 {
        cell.seen = cell.opposite(cell.neighbour_count() + 2) as u32;
    }
}

#[elementary_process]
fn ask_displacement(cell: &mut Cell<Place>) {
    if cell.number == 4 {
        cell.seen = cell.displacement(cell.neighbour_count() + 2).x as u32;
    }
}

#[elementary_process]
fn ask_existence(cell: &mut Cell<Place>) {
    if cell.number == 4 && cell.exists(cell.neighbour_count() + 2) {
        cell.seen = 1;
    }
}

#[test]
fn an_index_beyond_the_neighbourhood() -> Result<(), Box<dyn Error>> {
    let squares = || numbered([3, 2, 1], Neighbourhood::moore_2d(1));
    let hexagons = || numbered([4, 2, 1], Neighbourhood::hexagonal(Hexagons::SideUp));
    let cases = [
        (squares().process(ask_opposite), "ask_opposite", [0, 1, 0], 9),
        (squares().process(ask_displacement), "ask_displacement", [0, 1, 0], 9),
        (squares().process(ask_existence), "ask_existence", [0, 1, 0], 9),
        (hexagons().process(ask_opposite), "ask_opposite", [3, 0, 0], 7),
        (hexagons().process(ask_existence), "ask_existence", [3, 0, 0], 7),
    ];
    for (builder, process, cell, size) in cases {
        let model = builder.build()?;
        for precision in PRECISIONS {
            let options = RunOptions { precision, seed: 0 };
            let error = assert_same_fault(&model, &engines::all()?, options, 1);
            let RunError::Fault { fault, .. } = error else { return Err(error.into()) };
            let index = size as u32 + 2;
            assert_eq!(fault, Fault::BeyondNeighbourhood { process, cell, index, size });
        }
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Weighed {
    value: Real,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Weights {
    first: Vector4<Real>,
}

/// One number counts neighbours, elements and draws, without a cast.
#[elementary_process]
fn weigh(cell: &mut Cell<Weighed>, p: &Weights) {
    let weights = [0.0, p.first.x, p.first.y, p.first.z, p.first.w];
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        sum += weights[n] * cell.neighbour(n).value * cell.random(n);
    }
    cell.value = sum;
}

#[test]
fn one_number_counts_everything() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("weights")
        .extents([4, 3, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(Boundary::Reflecting)
        .substates::<Weighed>()
        .parameters(Weights { first: Vector4::new(1.0, 2.0, 4.0, 8.0) })
        .process(weigh)
        .fill(|site| {
            let [x, y, _] = site.cell();
            Weighed { value: (x + 10 * y + 1) as f64 }
        })
        .build()?;
    for precision in PRECISIONS {
        assert_same_runs(&model, &engines::all()?, RunOptions { precision, seed: 7 }, 3)?;
    }
    let mut simulation =
        Simulation::new(&model, &Reference, RunOptions { seed: 7, ..RunOptions::default() })?;
    simulation.step()?;
    // Of the first cell: itself to the south and west, cell 2 to the east, cell 11 to the north.
    let uniform = |number: u32| {
        let words = Draw { stream: Stream::process(0), step: 0, owner: 0, number }.words(7);
        f64::from(words[0] >> 5) * 67_108_864.0 + f64::from(words[1] >> 6)
    };
    let terms = [(1.0, 1.0, 1), (2.0, 1.0, 2), (4.0, 2.0, 3), (8.0, 11.0, 4)];
    let sum = terms.iter().fold(0.0, |sum, (weight, value, draw)| {
        sum + weight * value * (uniform(*draw) / 9_007_199_254_740_992.0)
    });
    assert_eq!(simulation.state().get(Weighed::VALUE, [0, 0, 0])?, sum);
    Ok(())
}
