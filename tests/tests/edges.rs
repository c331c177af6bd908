//! What passes the faces of a space: a lid that moves, an edge where lava leaves and is counted, and vents
//! that feed it.

use std::error::Error;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, PRECISIONS, describe};

type TestResult = Result<(), Box<dyn Error>>;

/// Lava in whole units, so that a balance is exact to the last bit.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Lava {
    /// 1 in every cell of the space, 0 beyond a flat face.
    inside: u8,
    thickness: i32,
    /// What has left the space from this cell.
    left: i32,
}

/// Lava levels out between neighbours. What flows to a place that is no cell has left.
#[elementary_process]
fn flow(cell: &mut Cell<Lava>) {
    let own = cell.thickness;
    let mut change = 0;
    for n in 1..cell.neighbour_count() {
        let out = (own - cell.neighbour(n).thickness) / 8;
        change -= out;
        if cell.neighbour(n).inside == 0 {
            cell.left += out;
        }
    }
    cell.thickness += change;
}

const VENTS: [[usize; 3]; 3] = [[2, 3, 0], [0, 0, 0], [5, 1, 0]];

fn lava(boundaries: Faces<Boundary>) -> Result<Model, ModelError> {
    Model::builder("lava")
        .extents([7, 5, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundaries(boundaries)
        .substates::<Lava>()
        .process(flow)
        .fill(|site| {
            let [x, y, _] = site.cell();
            Lava { inside: 1, thickness: (1000 * x * y) as i32, left: 0 }
        })
        .steer(Schedule::EveryFromStart(1), |state| {
            Ok(state.update(Lava::THICKNESS, &VENTS, |[x, ..], thickness| thickness + 100 + x as i32)?)
        })
        .build()
}

/// The initial lava, and what the vents give in a step, follow from the definition: what is there and what
/// has left must come to that.
#[test]
fn lava_leaves_through_open_edges_and_is_counted() -> TestResult {
    use Boundary::{Flat, Reflecting, Toroidal};
    let initial: i64 = (0..7).flat_map(|x| (0..5).map(move |y| 1000 * x * y)).sum();
    let fed: i64 = VENTS.iter().map(|[x, ..]| 100 + *x as i64).sum();
    let closed = Faces::all(Reflecting);
    for (boundaries, is_open) in [
        (closed, false),
        (Faces { north: Flat, ..closed }, true),
        (Faces { west: Flat, south: Flat, ..closed }, true),
        (Faces { south: Flat, ..Faces::from([Toroidal, Reflecting, Reflecting]) }, true),
        (Faces::from([Toroidal, Toroidal, Reflecting]), false),
    ] {
        let model = lava(boundaries)?;
        let mut snapshots = Vec::new();
        for engine in engines::all()? {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
            for step in 0..=20 {
                let state = simulation.state();
                let (there, left) = (state.sum(Lava::THICKNESS)?, state.sum(Lava::LEFT)?);
                // At step 0 the vents have acted once: steering of step 0 follows the initial state.
                let place = || format!("{boundaries}, step {step}, {}", describe(&*engine));
                assert_eq!(there + left, initial + fed * (step + 1), "{}", place());
                assert_eq!(left > 0, is_open && step > 0, "{}", place());
                simulation.step()?;
            }
            snapshots.push(simulation.snapshot()?);
        }
        assert!(snapshots.iter().all(|snapshot| *snapshot == snapshots[0]), "{boundaries}");
    }
    Ok(())
}

/// Steering of one step runs in the order added, at step 0 after the initial state; every schedule comes when
/// it must, in leaps too.
#[test]
fn schedules_of_sources() -> TestResult {
    let add = |amount: i32| {
        move |state: &mut State<'_>| Ok(state.update(Lava::THICKNESS, &[[0; 3]], |_, t| 10 * t + amount)?)
    };
    let model = Model::builder("sources")
        .extents([1, 1, 1])
        .substates::<Lava>()
        .steer(Schedule::EveryFromStart(4), add(1))
        .steer(Schedule::Every(2), add(2))
        .fill(|_| Lava { inside: 1, thickness: 0, left: 0 })
        .steer(Schedule::Every(4), add(3))
        .steer(Schedule::At(vec![0]), add(4))
        .build()?;
    for engine in engines::all()? {
        let thickness = |steps| -> Result<i32, Box<dyn Error>> {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
            simulation.run(steps)?;
            Ok(simulation.state().get(Lava::THICKNESS, [0; 3])?)
        };
        for (steps, wanted) in [(0, 14), (1, 14), (2, 142), (3, 142), (4, 142_123), (6, 1_421_232)] {
            assert_eq!(thickness(steps)?, wanted, "{steps} steps, {}", describe(&*engine));
        }
    }
    Ok(())
}

/// Cells in a batch, and the same cell twice.
#[test]
fn cells_set_and_changed_together() -> TestResult {
    let model = Model::builder("batch")
        .extents([4, 3, 3])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .boundary(Boundary::Toroidal)
        .substates::<Fluid>()
        .process(drag)
        .build()?;
    let cells = [[3, 2, 1], [0, 0, 0], [1, 0, 0], [3, 2, 1]];
    for precision in PRECISIONS {
        let mut after = Vec::new();
        for engine in engines::all()? {
            let options = RunOptions { precision, seed: 0 };
            let mut simulation = Simulation::new(&model, &*engine, options)?;
            // The halo that a step before has filled must follow what is set after it.
            simulation.step()?;
            let mut state = simulation.state();
            state.set_cells(Fluid::SPEED, cells.iter().copied().zip([1.0, 2.0, 3.0, 4.0]))?;
            assert_eq!(state.get_cells(Fluid::SPEED, &cells)?, [4.0, 2.0, 3.0, 4.0]);
            state.update(Fluid::SPEED, &cells, |[x, ..], speed| 2.0 * speed + x as f64)?;
            assert_eq!(state.get_cells(Fluid::SPEED, &cells)?, [25.0, 4.0, 7.0, 25.0]);
            assert_eq!(state.sum(Fluid::SPEED)?, 36.0);
            let unknown = [[0, 0, 0], [0, 3, 0]];
            for error in [
                state.update(Fluid::SPEED, &unknown, |_, _| -1.0),
                state.set_cells(Fluid::SPEED, unknown.map(|cell| (cell, -1.0))),
                state.get_cells(Fluid::SPEED, &unknown).map(|_| ()),
            ] {
                let error = error.expect_err("no such cell").to_string();
                assert_eq!(error, "the space of [4, 3, 3] cells has no cell [0, 3, 0]");
            }
            assert_eq!(state.sum(Fluid::SPEED)?, 36.0);
            simulation.step()?;
            after.push(simulation.snapshot()?);
        }
        assert!(after.iter().all(|snapshot| *snapshot == after[0]), "{precision}");
    }
    Ok(())
}

/// The speed of a fluid along x.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Fluid {
    speed: Real,
}

/// Each layer of fluid drags the next ones along.
#[elementary_process]
fn drag(cell: &mut Cell<Fluid>) {
    let mut change = 0.0;
    for n in 1..cell.neighbour_count() {
        change += cell.neighbour(n).speed - cell.speed;
    }
    cell.speed += 0.2 * change;
}

/// Couette flow under a lid that moves, without a row of cells for it: between a wall at rest and the lid the
/// speed grows in proportion to the distance from the wall's cells, which are those beyond the south face.
#[test]
fn a_lid_drags_the_fluid_along() -> TestResult {
    const LID: f64 = 0.1;
    let model = Model::builder("lid")
        .extents([4, 9, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundaries([Boundary::Toroidal, Boundary::Flat, Boundary::Flat])
        .substates::<Fluid>()
        .outside(Face::North, Fluid { speed: LID })
        .process(drag)
        .build()?;
    for precision in PRECISIONS {
        for engine in engines::all()? {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed: 0 })?;
            simulation.run(1500)?;
            for (cell, speed) in simulation.state().read(Fluid::SPEED)?.into_iter().enumerate() {
                let wanted = LID * (cell / 4 + 1) as f64 / 10.0;
                let tolerance = if precision == Precision::F32 { 1e-6 } else { 1e-12 };
                assert!((speed - wanted).abs() < tolerance, "{speed}, {wanted}, {}", describe(&*engine));
            }
        }
    }
    Ok(())
}

/// What a cell beyond two flat faces shows: of z, y and x the first whose face is flat there.
#[test]
fn beyond_edges_and_corners_the_last_axis_counts() -> TestResult {
    let model = Model::builder("corner")
        .extents([2, 2, 2])
        .neighbourhood(Neighbourhood::custom(vec![
            [0, 0, 0],
            [1, 0, 0],
            [1, 1, 0],
            [1, 1, 1],
            [1, 0, 1],
            [0, 1, 1],
        ])?)
        .substates::<Digits>()
        .outside(Face::East, Digits { digit: 1, all: 0 })
        .outside(Face::North, Digits { digit: 2, all: 0 })
        .outside(Face::Top, Digits { digit: 3, all: 0 })
        .process(look_around)
        .build()?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        simulation.step()?;
        assert_eq!(simulation.state().get(Digits::ALL, [1; 3])?, 12_333, "{}", describe(&*engine));
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Digits {
    digit: u32,
    all: u32,
}

#[elementary_process]
fn look_around(cell: &mut Cell<Digits>) {
    let mut all = 0;
    for n in 1..cell.neighbour_count() {
        all = 10 * all + cell.neighbour(n).digit;
    }
    cell.all = all;
}
