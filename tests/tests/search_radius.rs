//! A search reaches as far as the neighbourhood covers; further is a fault, the same on every engine.

use proptest::prelude::*;
use std::error::Error;
use xca_core::prelude::*;
use xca_core::{Fault, ModelBuilder};
use xca_tests::suite::cover::covered;
use xca_tests::suite::engines::{self, PRECISIONS, assert_same_fault, assert_same_runs};
use xca_tests::suite::lattice::Shape;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Speck {
    #[position]
    position: Vector3<Real>,
    near: u32,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Sight {
    radius: Real,
}

#[elementary_process]
fn look(me: &mut Slot<Speck>, p: &Sight) {
    for _other in me.others_within(p.radius) {
        me.near += 1;
    }
}

#[elementary_process]
fn look_at_neighbours(me: &mut Slot<Speck>, p: &Sight) {
    for _other in me.others_in_neighbours_within(p.radius) {
        me.near += 1;
    }
}

#[elementary_process]
fn look_at_home(me: &mut Slot<Speck>, p: &Sight) {
    for _other in me.others_in_cell_within(p.radius) {
        me.near += 1;
    }
}

/// Sides by hand: multiples are rounded as the engines round them.
#[elementary_process]
fn look_by_sides(me: &mut Slot<Speck>, p: &Sight, space: &Space) {
    for _other in me.others_within(p.radius * space.side()) {
        me.near += 1;
    }
}

/// By a radius that is no number, where the parameter is infinite.
#[elementary_process]
fn look_by_nothing(me: &mut Slot<Speck>, p: &Sight) {
    for _other in me.others_within(p.radius - p.radius) {
        me.near += 1;
    }
}

/// A row of cells with an item at each of these places along x.
fn row(side: f64, cells: usize, neighbourhood: Neighbourhood, radius: f64, places: &[f64]) -> ModelBuilder {
    let places = places.to_vec();
    // As thick as the neighbourhood needs.
    let thick = neighbourhood.reach()[1].max(1);
    Model::builder("row")
        .extents([cells, thick, thick])
        .cell_side(side)
        .neighbourhood(neighbourhood)
        .population::<Speck>(4)
        .parameters(Sight { radius })
        .initialise(move |state| {
            let item = |(label, place): (usize, &f64)| Item {
                label: label as u32 + 3,
                cell: [(place / side) as usize, 0, 0],
                state: Speck { position: Vector3::new(*place, 0.5 * side, 0.5 * side), near: 0 },
            };
            Ok(state.set_items(places.iter().enumerate().map(item).collect())?)
        })
}

/// The fault on all engines, the same in both precisions.
fn fault(builder: ModelBuilder) -> Result<(Fault, String), Box<dyn Error>> {
    let model = builder.build()?;
    let mut found = Vec::new();
    for precision in PRECISIONS {
        let error = assert_same_fault(&model, &engines::all()?, RunOptions { precision, seed: 0 }, 1);
        let message = error.to_string();
        let RunError::Fault { fault, .. } = error else { return Err(message.into()) };
        found.push((fault, message));
    }
    assert_eq!(found[0].1, found[1].1);
    found.pop().ok_or_else(|| "no precision".into())
}

/// How many others each item finds, on all engines, in both precisions.
fn found(builder: ModelBuilder) -> Result<Vec<u32>, Box<dyn Error>> {
    let model = builder.build()?;
    let mut found = Vec::new();
    for precision in PRECISIONS {
        let options = RunOptions { precision, seed: 0 };
        assert_same_runs(&model, &engines::all()?, options, 1)?;
        let mut simulation = Simulation::new(&model, &Reference, options)?;
        simulation.step()?;
        found.push(simulation.state().read(Speck::NEAR)?);
    }
    assert_eq!(found[0], found[1]);
    Ok(found.swap_remove(0))
}

/// The two are 1.3 m apart and their cells do not touch: a list that is too short would miss one.
#[test]
fn too_far_a_search() -> Result<(), Box<dyn Error>> {
    let apart = || row(1.0, 5, Neighbourhood::moore(1), 1.5, &[0.9, 2.2]);
    let (fault_found, message) = fault(apart().process(look))?;
    let wanted =
        Fault::SearchTooFar { process: "look", cell: [0, 0, 0], label: Some(3), radius: 1.5, covered: 1.0 };
    assert_eq!(fault_found, wanted);
    assert_eq!(
        message,
        "step 1: `look` searches within 1.5 m around item 3 in cell [0, 0, 0], but the neighbourhood \
         covers 1 m; use a wider neighbourhood (Moore covers its radius times the cell side) or larger cells"
    );
    let (fault_found, _) = fault(apart().process(look_at_neighbours))?;
    assert!(matches!(fault_found, Fault::SearchTooFar { process: "look_at_neighbours", .. }));
    // What the message says helps; and the own cell is never too small.
    assert_eq!(found(row(1.0, 5, Neighbourhood::moore(2), 1.5, &[0.9, 2.2]).process(look))?, [1, 1]);
    assert_eq!(found(row(1.5, 5, Neighbourhood::moore(1), 1.5, &[0.9, 2.2]).process(look))?, [1, 1]);
    assert_eq!(found(apart().process(look_at_home))?, [0, 0]);
    Ok(())
}

#[test]
fn a_radius_is_a_number_that_is_not_negative() -> Result<(), Box<dyn Error>> {
    for radius in [-0.25, f64::NEG_INFINITY] {
        let model = || row(1.0, 3, Neighbourhood::moore(1), radius, &[0.5, 0.75]);
        let searches = [
            ("look", model().process(look)),
            ("look_at_neighbours", model().process(look_at_neighbours)),
            ("look_at_home", model().process(look_at_home)),
        ];
        for (name, builder) in searches {
            let (fault, message) = fault(builder)?;
            assert!(matches!(fault, Fault::InvalidRadius { label: Some(3), .. }), "{fault:?}");
            assert_eq!(
                message,
                format!(
                    "step 1: `{name}` searches within {radius} m around item 3 in cell [0, 0, 0]; a radius is at least 0"
                )
            );
        }
    }
    // A parameter is a number; what is computed of it may be none.
    let builder = row(1.0, 3, Neighbourhood::moore(1), f64::INFINITY, &[0.5, 0.75]).process(look_by_nothing);
    let (fault, message) = fault(builder)?;
    assert!(matches!(fault, Fault::InvalidRadius { label: Some(3), .. }), "{fault:?}");
    assert!(message.contains("searches within NaN m around item 3"), "{message}");
    // Nothing is nearer than 0, of either sign.
    for zero in [0.0, -0.0] {
        assert_eq!(found(row(1.0, 3, Neighbourhood::moore(1), zero, &[0.5, 0.5]).process(look))?, [0, 0]);
    }
    Ok(())
}

/// As many sides of a cell as the radius of a cube are never refused, however they are rounded.
#[test]
fn whole_sides_are_covered() -> Result<(), Box<dyn Error>> {
    for side in [0.1, 0.3, 1.0 / 3.0, 2.5e-3, 7.0, 1e-9] {
        for sides in 1..=3_u8 {
            let places = [0.5 * side, 1.25 * side];
            let by_sides = row(side, 9, Neighbourhood::moore(sides), f64::from(sides), &places);
            assert_eq!(found(by_sides.process(look_by_sides))?, [1, 1], "{side} {sides}");
        }
    }
    Ok(())
}

/// Where the neighbourhood holds the whole space there is nothing beyond it.
#[test]
fn a_whole_space_has_no_limit() -> Result<(), Box<dyn Error>> {
    for radius in [2.9, f64::INFINITY] {
        let whole = row(1.0, 2, Neighbourhood::von_neumann(1), radius, &[0.1, 1.9]);
        assert_eq!(found(whole.process(look))?, [1, 1]);
    }
    let (fault, _) = fault(row(1.0, 3, Neighbourhood::von_neumann(1), 1.25, &[0.1, 1.9]).process(look))?;
    assert!(matches!(fault, Fault::SearchTooFar { covered: 1.0, .. }), "{fault:?}");
    Ok(())
}

fn neighbourhoods() -> impl Strategy<Value = Neighbourhood> {
    let ready_made = proptest::sample::select(Shape::ALL.to_vec()).prop_map(Shape::neighbourhood);
    // Cubes with a few holes.
    let holed = proptest::collection::vec(1_usize..125, 0..4).prop_map(|holes| {
        let cube = Neighbourhood::moore(2);
        let all = cube.displacements([0; 3]).iter().enumerate();
        let kept = all.filter(|(index, _)| !holes.contains(index)).map(|(_, step)| *step).collect();
        Neighbourhood::custom(kept).unwrap_or(cube)
    });
    prop_oneof![ready_made, holed]
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 200,
        failure_persistence: None,
        rng_seed: proptest::test_runner::RngSeed::Fixed(7),
        ..ProptestConfig::default()
    })]

    /// The covered radius is the least distance between cells that do not see each other.
    #[test]
    fn what_is_covered(
        neighbourhood in neighbourhoods(),
        extents in [1_usize..7, 1_usize..7, 1_usize..7],
        torus in [any::<bool>(), any::<bool>(), any::<bool>()],
    ) {
        let boundaries = torus.map(|torus| if torus { Boundary::Toroidal } else { Boundary::Flat });
        let model = Model::builder("space")
            .extents(extents)
            .neighbourhood(neighbourhood.clone())
            .boundaries(boundaries)
            .population::<Speck>(1)
            .build();
        // What does not fit the space is no model.
        if let Ok(model) = model {
            let wanted = covered(&neighbourhood, extents, boundaries.into());
            prop_assert_eq!(model.geometry().covered_radius(Precision::F64), wanted);
        }
    }
}
