//! Parts whose bounds follow the work while it moves through the space.

use crate::items::{self, Walker, crowd, meet, settle, walk, wear};
use crate::{TestResult, count, cpu};
use std::error::Error;
use std::num::NonZeroU64;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use xca_core::engine::{Border, Execution, Figure, Part, StartError};
use xca_core::prelude::*;
use xca_core::{NeighbourhoodError, Snapshot};
use xca_cpu::Cpu;
use xca_parts::{Balance, Grid, Parts};

/// Bounds move whenever a look at the work shows a better cut.
fn eager(every: u64) -> Balance {
    Balance { every: NonZeroU64::new(every), cost: 0 }
}

/// A figure of an engine.
pub(crate) fn figure(figures: &[Figure], name: &str) -> Result<f64, String> {
    let found = figures.iter().find(|figure| figure.name == name);
    found.map(|figure| figure.value).ok_or_else(|| format!("no {name} in {figures:?}"))
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Sky {
    light: u32,
    warmth: Real,
    seen: u32,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Path {
    /// Light in this row along y is a fault.
    end: i32,
}

#[elementary_process]
fn drift(cell: &mut Cell<Sky>) {
    cell.light = cell.neighbour(1).light;
}

#[elementary_process]
fn warm(cell: &mut Cell<Sky>) {
    if cell.light > 0 {
        cell.warmth += cell.random(0) * (cell.light as Real);
        cell.seen += 1;
    }
}

#[elementary_process]
fn arrive(cell: &mut Cell<Sky>, path: &Path) {
    if cell.light > 0 && cell.index().y == path.end {
        cell.fault(3, cell.light as Real);
    }
}

/// A light of three cells a side that goes along y and z, and around the space. Nothing else changes.
fn comet(end: i32) -> Result<Model, Box<dyn Error>> {
    let behind: Result<_, NeighbourhoodError> = Neighbourhood::custom(vec![[0, 0, 0], [0, -1, -1]]);
    let is_lit = |cell: [usize; 3]| cell.iter().all(|index| (1..4).contains(index));
    let model = Model::builder("comet")
        .extents([7, 12, 10])
        .neighbourhood(behind?)
        .boundary(Boundary::Toroidal)
        .substates::<Sky>()
        .parameters(Path { end })
        .process((drift, warm, arrive))
        .fault_text(3, "arrived")
        .fill(move |site| Sky {
            light: if is_lit(site.cell()) { 1 + site.cell()[0] as u32 } else { 0 },
            warmth: 0.0,
            seen: 0,
        });
    Ok(model.build()?)
}

/// What a run comes to, step by step.
fn snapshots(
    model: &Model,
    engine: &dyn Engine,
    steps: u64,
) -> Result<(Vec<Snapshot>, Vec<Figure>), Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions::default())?;
    let mut all = Vec::new();
    for _ in 0..steps {
        simulation.step()?;
        all.push(simulation.snapshot()?);
    }
    Ok((all, simulation.figures()))
}

const GRIDS: [Grid; 4] = [Grid { y: 3, z: 1 }, Grid { y: 1, z: 4 }, Grid { y: 2, z: 2 }, Grid { y: 4, z: 3 }];

#[test]
fn bounds_that_follow_a_light_change_no_bit() -> TestResult {
    let model = comet(-1)?;
    let (wanted, _) = snapshots(&model, &Reference, 45)?;
    for (number, grid) in GRIDS.into_iter().enumerate() {
        for every in [1, 3] {
            let parts = Parts::with_grid(cpu(1 + number % 2, 1 + number)?, grid).with_balance(eager(every));
            let (got, figures) = snapshots(&model, &parts, 45)?;
            for (step, (got, wanted)) in got.iter().zip(&wanted).enumerate() {
                assert!(got == wanted, "{grid}, a look every {every} steps, step {step}");
            }
            let moved = figure(&figures, "bounds_moved")?;
            assert!(moved >= 4.0, "{grid}, a look every {every} steps: {moved} moves");
        }
    }
    Ok(())
}

/// In batches of steps, the bounds move between them. The figures tell where they are.
#[test]
fn bounds_are_where_the_light_is() -> TestResult {
    let model = comet(-1)?;
    let grid = Grid { y: 2, z: 1 };
    let run = |balance: Balance| -> Result<_, Box<dyn Error>> {
        let parts = Parts::with_grid(cpu(1, 1)?, grid).with_balance(balance);
        let mut simulation = Simulation::new(&model, &parts, RunOptions::default())?;
        simulation.run(4)?;
        let figures = simulation.figures();
        let ends = ["part_0_y_start", "part_0_y_end", "part_1_y_start", "part_1_y_end"];
        let ends = ends.map(|name| figure(&figures, name));
        Ok((ends.into_iter().collect::<Result<Vec<_>, _>>()?, figures))
    };
    // After three steps the light is in rows 4 to 6. The fourth step begins with the bounds in its middle.
    let (ends, figures) = run(eager(2))?;
    assert_eq!((ends[0], ends[3], figure(&figures, "bounds_moved")?), (0.0, 12.0, 1.0));
    assert!(ends[1] == ends[2] && (3.0..6.0).contains(&ends[1]), "{ends:?}");
    let (ends, figures) = run(Balance::NEVER)?;
    assert_eq!((ends, figure(&figures, "bounds_moved")?), (vec![0.0, 6.0, 6.0, 12.0], 0.0));
    Ok(())
}

/// A short run does not pay for a move, and a balanced one needs none.
#[test]
fn bounds_stay_if_a_move_does_not_pay() -> TestResult {
    let parts = Parts::with_grid(cpu(1, 1)?, Grid { y: 3, z: 1 });
    let (_, figures) = snapshots(&comet(-1)?, &parts, 200)?;
    assert_eq!(figure(&figures, "bounds_moved")?, 0.0);
    let (all_cells, eager) = (cpu(1, 0)?, eager(1));
    let (_, figures) =
        snapshots(&comet(-1)?, &Parts::with_grid(all_cells, Grid { y: 3, z: 2 }).with_balance(eager), 9)?;
    assert_eq!((figure(&figures, "bounds_moved")?, figure(&figures, "imbalance")?), (0.0, 1.0));
    Ok(())
}

/// Goes to the first row along y, and rests there.
#[elementary_process]
fn rush(me: &mut Slot<Walker>) {
    let back = if me.position.y > 1.0 { 0.7 } else { 0.0 };
    me.velocity = Vector3::new(0.9 * me.velocity.x, -back, 0.8 * me.velocity.z);
}

/// Walkers heap up at one side, and some leave the space.
#[test]
fn bounds_that_follow_items_change_no_bit() -> TestResult {
    for extents in [[5, 9, 1], [4, 8, 6]] {
        let model =
            crowd(extents, Boundary::Flat, 80, 90).process((meet, rush, walk, settle, wear)).build()?;
        let (wanted, _) = items::run_and_report(&model, &Reference)?;
        let grids = GRIDS.iter().filter(|grid| grid.z <= extents[2]);
        for (number, grid) in grids.enumerate() {
            let parts = Parts::with_grid(cpu(1 + number % 2, number)?, *grid).with_balance(eager(1));
            let (got, figures) = items::run_and_report(&model, &parts)?;
            for (step, (got, wanted)) in got.iter().zip(&wanted).enumerate() {
                assert!(got == wanted, "{extents:?} {grid}, step {step}");
            }
            let moved = figure(&figures, "bounds_moved")?;
            assert!(moved >= 1.0 || grid.y == 1, "{extents:?} {grid}: {moved} moves");
        }
        let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
        simulation.run(items::STEPS)?;
        assert!(simulation.state().count_left::<Walker>()? > 0, "{extents:?}");
    }
    Ok(())
}

/// Items that lie at one side from the start: bounds move before the first step.
#[test]
fn bounds_move_to_items_that_are_set() -> TestResult {
    let item = |label: u32| Item {
        label,
        cell: [label as usize % 5, label as usize / 40, 0],
        state: Walker {
            position: Vector3::new(0.5, 0.5, 0.5),
            velocity: Vector3::new(0.0, 0.0, 0.0),
            met: 0,
            heard: [0.0; 2],
        },
    };
    let model = Model::builder("heap")
        .extents([5, 20, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .population::<Walker>(20)
        .process(rush)
        .initialise(move |state| Ok(state.set_items((0..160).map(item).collect::<Vec<_>>())?))
        .build()?;
    // The cost counts: 32 of 100 cells and 160 items, against 160 items in 32 steps.
    for (balance, end, moved) in [(Balance::default(), 2.0, 1.0), (Balance::NEVER, 10.0, 0.0)] {
        let parts = Parts::new(cpu(1, 1)?, count(2)?).with_balance(balance);
        let mut simulation = Simulation::new(&model, &parts, RunOptions::default())?;
        assert_eq!(figure(&simulation.figures(), "part_0_y_end")?, 10.0);
        simulation.step()?;
        let figures = simulation.figures();
        assert_eq!((figure(&figures, "part_0_y_end")?, figure(&figures, "bounds_moved")?), (end, moved));
    }
    Ok(())
}

/// In the first rows along y a walker cannot go on.
#[elementary_process]
fn halt(me: &mut Slot<Walker>) {
    if me.position.y < 2.0 {
        me.fault(4, me.position.y);
    }
}

/// Bounds move right after a fault, because its state is replaced. What parts have sent before is dropped.
#[test]
fn bounds_move_after_a_fault() -> TestResult {
    let item = |label: u32| {
        let [x, y] = [label as usize % 5, 15 + label as usize / 40];
        let position = Vector3::new(x as f64 + 0.5, y as f64 + 0.5, 0.5);
        let velocity = Vector3::new(0.0, 0.0, 0.0);
        Item { label, cell: [x, y, 0], state: Walker { position, velocity, met: 0, heard: [0.0; 2] } }
    };
    let model = Model::builder("march")
        .extents([5, 20, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .population::<Walker>(20)
        .process((meet, rush, walk, settle, halt))
        .fault_text(4, "at the end")
        .initialise(move |state| Ok(state.set_items((0..160).map(item).collect::<Vec<_>>())?))
        .build()?;
    let outcome = |engine: &dyn Engine| -> Result<_, Box<dyn Error>> {
        let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
        let first = simulation.snapshot()?;
        let mut faults = Vec::new();
        for _ in 0..3 {
            let fault = simulation.run(60).expect_err("a walker arrives");
            faults.push(format!("{fault:?}"));
            simulation.restore(&first)?;
        }
        Ok((faults, simulation.figures()))
    };
    let (wanted, _) = outcome(&Reference)?;
    for parts in [2, 3, 5] {
        let engine = Parts::new(cpu(1, 1)?, count(parts)?).with_balance(eager(1));
        let (faults, figures) = outcome(&engine)?;
        assert_eq!(faults, wanted, "{parts} parts");
        assert!(figure(&figures, "bounds_moved")? >= 6.0, "{figures:?}");
    }
    Ok(())
}

/// After moves a fault is that of one engine, the state is there, and a snapshot brings the run back.
#[test]
fn faults_after_moves_are_the_same() -> TestResult {
    let model = comet(11)?;
    let outcome = |engine: &dyn Engine| -> Result<_, Box<dyn Error>> {
        let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
        simulation.run(5)?;
        let snapshot = simulation.snapshot()?;
        let error = simulation.run(20).expect_err("the light arrives");
        simulation.state().read(Sky::LIGHT)?;
        let figures = simulation.figures();
        simulation.restore(&snapshot)?;
        let again = simulation.run(20).expect_err("the light arrives again");
        Ok(([error, again].map(|error| format!("{error} {error:?}")), snapshot, figures))
    };
    let wanted = outcome(&Reference)?;
    assert!(wanted.0[0].contains("arrived"));
    for grid in GRIDS {
        let parts = Parts::with_grid(cpu(1, 2)?, grid).with_balance(eager(1));
        let (errors, snapshot, figures) = outcome(&parts)?;
        assert_eq!(errors, wanted.0, "{grid}");
        assert!(snapshot == wanted.1, "{grid}");
        assert!(figure(&figures, "bounds_moved")? >= 2.0, "{grid}");
    }
    Ok(())
}

/// A snapshot of moved parts is resumed in other parts.
#[test]
fn runs_resume_in_other_parts() -> TestResult {
    let model = comet(-1)?;
    let (wanted, _) = snapshots(&model, &Reference, 30)?;
    let parts = |grid: Grid| -> Result<_, Box<dyn Error>> {
        Ok(Parts::with_grid(cpu(1, 2)?, grid).with_balance(eager(1)))
    };
    for (number, grid) in GRIDS.into_iter().enumerate() {
        let (early, figures) = snapshots(&model, &parts(grid)?, 17)?;
        assert!(figure(&figures, "bounds_moved")? >= 2.0, "{grid}");
        let engine = parts(GRIDS[(number + 1) % GRIDS.len()])?;
        let mut resumed = Simulation::resume(&model, &engine, RunOptions::default(), &early[16])?;
        resumed.run(13)?;
        assert!(resumed.snapshot()? == wanted[29], "{grid}");
    }
    Ok(())
}

/// The CPU engine, which can start so many parts and no more.
#[derive(Debug, Clone)]
struct Tired {
    engine: Cpu,
    starts: Arc<AtomicUsize>,
    panics: bool,
}

impl Engine for Tired {
    fn name(&self) -> &str {
        "tired"
    }

    fn threads(&self) -> usize {
        1
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        self.engine.start(model, precision)
    }

    fn start_part(
        &self,
        model: &Model,
        precision: Precision,
        part: &Part,
        border: Box<dyn Border>,
    ) -> Result<Box<dyn Execution>, StartError> {
        if self.starts.fetch_sub(1, Ordering::Relaxed) == 1 {
            assert!(!self.panics, "no memory is left");
            return Err(StartError::Other {
                engine: "tired".to_owned(),
                reason: "no memory is left".to_owned(),
            });
        }
        self.engine.start_part(model, precision, part, border)
    }
}

/// If a part cannot start again, all parts end, and the reason is told. None waits.
#[test]
fn a_part_that_cannot_start_again_ends_all() -> TestResult {
    let model = comet(-1)?;
    // Three parts start at first, then three at each move.
    for starts in 4..10 {
        for panics in [false, true] {
            let engine = Tired { engine: cpu(1, 1)?, starts: Arc::new(AtomicUsize::new(starts)), panics };
            let parts = Parts::with_grid(engine, Grid { y: 3, z: 1 }).with_balance(eager(1));
            let mut simulation = Simulation::new(&model, &parts, RunOptions::default())?;
            let error = simulation.run(60).expect_err("a part cannot start").to_string();
            assert!(error.contains("part ") && error.contains("no memory is left"), "{error}");
            let again = simulation.state().read(Sky::LIGHT).expect_err("no part goes on").to_string();
            assert!(again.contains("no memory is left"), "{again}");
        }
    }
    Ok(())
}
