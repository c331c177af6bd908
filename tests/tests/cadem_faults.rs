//! What leaves, what stops a run, and what is refused before it begins.

mod cadem_support;

use cadem::{Case, Configuration, Dem, Diagnostics, Face, Opening, Particle, Rectangle, Walls, processes};
use cadem_support::{TestResult, start, weightless};
use xca_core::engine::Fault;
use xca_core::prelude::*;

fn moving(label: u32, position: [f64; 3], velocity: [f64; 3]) -> Particle {
    Particle { label, position, velocity }
}

/// The particle over the hole in the floor leaves and is counted; its neighbour bounces.
#[test]
fn particles_leave_through_openings_and_are_counted() -> TestResult {
    for walls in Walls::ALL {
        // Under the law per-slot the pieces around a hole still act on what falls into it, so that this hole
        // is wider.
        let hole = match walls {
            Walls::Single => Rectangle { first: [1, 1], last: [1, 1] },
            Walls::PerSlot => Rectangle { first: [0, 0], last: [2, 2] },
        };
        let configuration = Configuration {
            cells: [5, 3, 3],
            gravity: 300.0,
            walls,
            openings: vec![Opening { face: Face::ZLow, cells: Some(hole) }],
            ..Case::Table1.configuration()
        };
        let particles =
            vec![Particle::at_rest(1, [0.003, 0.003, 0.003]), Particle::at_rest(2, [0.009, 0.003, 0.003])];
        let mut simulation = start(&configuration, particles)?;
        simulation.run(1000)?;
        let seen = Diagnostics::of(&simulation.state(), walls)?;
        assert_eq!((seen.particles, seen.left), (1, 1), "{walls}");
        assert_eq!(cadem::particles(&simulation.state())?[0].label, 2);
    }
    Ok(())
}

#[test]
fn without_walls_all_particles_leave_at_last() -> TestResult {
    let particles = (1..=6).zip([
        [-1.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, -1.0],
        [0.0, 0.0, 1.0],
    ]);
    let particles = particles.map(|(label, velocity)| {
        moving(label, velocity.map(|component| 0.003 + 0.001 * component), velocity)
    });
    let mut simulation = start(&weightless([3; 3]), particles.collect())?;
    simulation.run(200)?;
    let seen = Diagnostics::of(&simulation.state(), Walls::Single)?;
    assert_eq!((seen.particles, seen.left, seen.largest_occupancy), (0, 6, 0));
    Ok(())
}

fn fault_of(error: RunError) -> (u64, Fault, String) {
    let message = error.to_string();
    match error {
        RunError::Fault { step, fault, .. } => (step, fault, message),
        other => panic!("{other}"),
    }
}

#[test]
fn a_full_cell_stops_the_run() -> TestResult {
    let configuration = Configuration { slots: Some(1), ..weightless([3; 3]) };
    // One particle waits for the other.
    let particles = vec![
        Particle::at_rest(1, [0.003, 0.003, 0.003]),
        moving(2, [0.0055, 0.003, 0.003], [-10.0, 0.0, 0.0]),
    ];
    let mut simulation = start(&configuration, particles)?;
    let (step, fault, message) = fault_of(simulation.run(100).expect_err("two particles, one slot"));
    // 1.5 mm at 0.11 mm a step.
    assert_eq!(step, 14);
    assert_eq!(fault, Fault::CellFull { process: Some("reassign"), cell: [1, 1, 1], items: 2, slots: 1 });
    for part in ["step 14", "`reassign`", "[1, 1, 1]", "2 items", "1 slot"] {
        assert!(message.contains(part), "{message}");
    }
    // The same at the start.
    let particles = vec![Particle::at_rest(1, [0.0025; 3]), Particle::at_rest(2, [0.0035; 3])];
    let error = start(&configuration, particles).expect_err("two particles, one slot");
    assert!(error.to_string().contains("would hold 2 items, but a cell has 1 slot;"), "{error}");
    Ok(())
}

#[test]
fn a_particle_too_fast_stops_the_run() -> TestResult {
    let configuration = weightless([9; 3]);
    // The radius in one step is 44.72 m/s.
    let mut simulation = start(&configuration, vec![moving(5, [0.009; 3], [44.0, 0.0, 0.0])])?;
    simulation.run(3)?;
    let mut simulation = start(&configuration, vec![moving(5, [0.009; 3], [0.0, 45.0, 0.0])])?;
    let (step, fault, message) = fault_of(simulation.run(3).expect_err("too fast"));
    let expected = Fault::Reported {
        process: "displace",
        cell: [4; 3],
        label: Some(5),
        code: processes::TOO_FAST,
        value: 45.0,
    };
    assert_eq!((step, fault), (1, expected));
    assert_eq!(
        message,
        "step 1: a particle moves further than its radius in one step (the value is its speed in m/s; a smaller time step helps): \
         `displace` reports fault 1 with value 45 for item 5 in cell [4, 4, 4]"
    );
    Ok(())
}

#[test]
fn a_velocity_that_is_no_number_stops_the_run() -> TestResult {
    let configuration = Configuration { allow_overlaps: true, ..weightless([3; 3]) };
    // Two centres at one place have no normal.
    let particles = vec![Particle::at_rest(1, [0.003; 3]), Particle::at_rest(2, [0.003; 3])];
    let mut simulation = start(&configuration, particles)?;
    let (step, fault, message) = fault_of(simulation.run(3).expect_err("no number"));
    assert_eq!(step, 1);
    let Fault::Reported { label: Some(1), code: processes::NOT_A_NUMBER, value, .. } = fault else {
        panic!("{fault}")
    };
    assert!(value.is_nan());
    assert!(message.contains("NaN"), "{message}");
    Ok(())
}

/// So deep in a wall that the centre is beyond: with closed walls nothing leaves.
#[test]
fn a_particle_shot_through_a_wall_stops_the_run() -> TestResult {
    let configuration = Configuration { cells: [3; 3], ..Case::Table1.configuration() };
    let mut simulation = start(&configuration, vec![moving(8, [0.003, 0.003, 0.001], [0.0, 0.0, -44.0])])?;
    let (_, fault, message) = fault_of(simulation.run(3).expect_err("out of the box"));
    assert_eq!(fault, Fault::Left { process: "reassign", label: 8, cell: [1, 1, 0] });
    assert!(message.contains("item 8"), "{message}");
    // Nor where the wall has an opening elsewhere.
    for walls in Walls::ALL {
        let hole = Rectangle { first: [0, 0], last: [0, 0] };
        let openings = vec![Opening { face: Face::ZLow, cells: Some(hole) }];
        let configuration = Configuration { walls, openings, ..configuration.clone() };
        let mut simulation =
            start(&configuration, vec![moving(8, [0.003, 0.003, 0.001], [0.0, 0.0, -44.0])])?;
        let (step, fault, message) = fault_of(simulation.run(3).expect_err("out of the box"));
        let Fault::Reported { label: Some(8), code: processes::THROUGH_WALL, value, .. } = fault else {
            panic!("{fault}")
        };
        assert!(step <= 3 && (20.0..=44.01).contains(&value), "{message}");
        // Through the hole it may.
        let shot = vec![moving(8, [0.001, 0.001, 0.001], [0.0, 0.0, -44.0])];
        let mut simulation = start(&configuration, shot)?;
        simulation.run(3)?;
        assert_eq!(simulation.state().count_left::<Dem>()?, 1);
    }
    Ok(())
}

/// A parameter that is changed after the model was built is checked when a run begins, and moves the walls.
#[test]
fn parameters_of_a_built_model_are_checked_at_the_start() -> TestResult {
    let configuration =
        Configuration { cells: [3; 3], walls: Walls::PerSlot, ..Case::Table1.configuration() };
    let mut model = cadem::model(&configuration, vec![Particle::at_rest(1, [0.003; 3])])?;
    model.set_parameter("radius", "0.0006")?;
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    let items = simulation.state().items::<Dem>()?;
    assert_eq!(items.iter().filter(|item| item.state.position.z == 0.0006).count(), 9);
    model.set_parameter("radius", "0.0011")?;
    let error = Simulation::new(&model, &Reference, RunOptions::default()).expect_err("wider than a cell");
    assert!(error.to_string().contains("at least two radii of 0.0011 m"), "{error}");
    Ok(())
}

/// In f32 the last position below the lid is the lid.
#[test]
fn positions_are_rounded_before_they_are_put_into_cells() -> TestResult {
    let configuration = weightless([1, 1, 3]);
    let below = f64::from_bits(0.004_f64.to_bits() - 1);
    let model = cadem::model(&configuration, vec![Particle::at_rest(1, [0.001, 0.001, below])])?;
    for (precision, cell) in [(Precision::F64, [0, 0, 1]), (Precision::F32, [0, 0, 2])] {
        let mut simulation =
            Simulation::new(&model, &Reference, RunOptions { precision, ..RunOptions::default() })?;
        assert_eq!(simulation.state().items::<Dem>()?[0].cell, cell, "{precision}");
        simulation.step()?;
        assert_eq!(simulation.state().items::<Dem>()?[0].cell, cell, "{precision}");
    }
    Ok(())
}
