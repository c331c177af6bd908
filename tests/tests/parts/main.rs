//! Models in parts of their space: the same bits, the same faults, and an end where a part cannot go on.

mod borders;
mod faults;
mod flows;
mod gpu;
mod greetings;
mod items;
mod lists;
mod models;
mod moves;
mod traffic;
mod wakes;

use borders::{Behind, Manner};
use models::{Site, life, wood};
use std::error::Error;
use std::num::NonZeroUsize;
use xca_core::engine::{EngineFailure, InputError, Part, StartError, SubstateId};
use xca_core::prelude::*;
use xca_core::{Fault, NeighbourhoodError, Snapshot};
use xca_cpu::Cpu;
use xca_parts::{Grid, Parts};

type TestResult = Result<(), Box<dyn Error>>;

use Boundary::{Flat, Reflecting, Toroidal};

fn count(parts: usize) -> Result<NonZeroUsize, &'static str> {
    NonZeroUsize::new(parts).ok_or("no parts")
}

fn cpu(threads: usize, tiles: usize) -> Result<Cpu, Box<dyn Error>> {
    let cpu = Cpu::with_threads(threads)?;
    Ok(match NonZeroUsize::new(tiles) {
        Some(cells) => cpu.with_tiles(cells),
        None => cpu.without_tiles(),
    })
}

/// What a simulation looks like after a step.
#[derive(Debug, PartialEq)]
struct Seen {
    snapshot: Snapshot,
    fuel: i64,
    /// Sums of floats depend on their order.
    heat: u64,
    corner: u32,
}

const STEPS: u64 = 18;

/// What is seen after each step, some of which are done twice, and after a last leap.
fn run(model: &Model, engine: &dyn Engine) -> Result<Vec<Seen>, Box<dyn Error>> {
    run_in(model, engine, Precision::F32)
}

fn run_in(model: &Model, engine: &dyn Engine, precision: Precision) -> Result<Vec<Seen>, Box<dyn Error>> {
    let options = RunOptions { precision, seed: 7 };
    let mut simulation = Simulation::new(model, engine, options)?;
    let last = model.geometry().extents().map(|extent| extent - 1);
    let mut seen: Vec<Seen> = Vec::new();
    for step in 0..STEPS {
        if step == 10 {
            simulation.restore(&seen[4].snapshot)?;
        }
        // Parts do the steps of a leap without asking each other.
        simulation.run(if step + 1 == STEPS { 20 } else { 1 })?;
        let snapshot = simulation.snapshot()?;
        let state = simulation.state();
        let heat = state.sum(Site::HEAT)?.to_bits();
        let corner = state.get_cells(Site::LIT, &[last, [0; 3], last])?.into_iter().sum();
        seen.push(Seen { snapshot, fuel: state.sum(Site::FUEL)?, heat, corner });
    }
    Ok(seen)
}

/// A space with cuts of it.
struct Case {
    extents: [usize; 3],
    neighbourhood: Neighbourhood,
    /// Parts along y and z.
    cuts: Vec<[usize; 2]>,
}

/// Among them are such whose parts are as thin as the model reaches.
fn cases() -> Result<Vec<Case>, NeighbourhoodError> {
    let far = Neighbourhood::custom(vec![[0, 0, 0], [3, 0, 0], [-1, 2, 0], [0, -1, 1]])?;
    let cases = vec![
        ([40, 8, 1], Neighbourhood::von_neumann_2d(1), vec![[2, 1], [3, 1], [8, 1]]),
        ([23, 9, 1], Neighbourhood::moore_2d(2), vec![[2, 1], [4, 1]]),
        ([9, 4, 6], Neighbourhood::moore(1), vec![[2, 1], [1, 2], [2, 3], [4, 6]]),
        ([5, 6, 7], Neighbourhood::moore(2), vec![[3, 1], [1, 3], [2, 2], [3, 3]]),
        ([17, 8, 1], Neighbourhood::hexagonal(Hexagons::CornerUp), vec![[2, 1], [5, 1]]),
        ([16, 7, 1], Neighbourhood::hexagonal(Hexagons::SideUp), vec![[2, 1], [7, 1]]),
        ([40, 5, 3], far, vec![[2, 1], [1, 3], [2, 2]]),
    ];
    let case = |(extents, neighbourhood, cuts)| Case { extents, neighbourhood, cuts };
    Ok(cases.into_iter().map(case).collect())
}

/// For each engine of a part its threads, and the cells of its tiles, 0 for none.
const MANNERS: [(usize, usize); 4] = [(1, 1), (2, 3), (3, 0), (1, 64)];

#[test]
fn same_bits_in_any_parts() -> TestResult {
    let one_sided = Faces { south: Reflecting, top: Reflecting, ..Faces::all(Flat) };
    let all = [
        Faces::all(Flat),
        Faces::all(Toroidal),
        Faces::all(Reflecting),
        Faces::from([Toroidal, Reflecting, Flat]),
        Faces::from([Flat, Toroidal, Reflecting]),
        Faces::from([Reflecting, Flat, Toroidal]),
        one_sided,
    ];
    for (number, Case { extents, neighbourhood, cuts }) in cases()?.into_iter().enumerate() {
        for (other, boundaries) in all.into_iter().enumerate() {
            let reflects = Face::ALL.iter().any(|face| boundaries[*face] == Reflecting);
            if reflects && neighbourhood.parity() != xca_core::Parity::None {
                continue;
            }
            for warms in [false, true] {
                let model = wood(extents, neighbourhood.clone(), boundaries, warms)?;
                let wanted = run(&model, &Reference)?;
                for (turn, [y, z]) in cuts.iter().enumerate() {
                    let (threads, tiles) = MANNERS[(number + other + turn) % MANNERS.len()];
                    let parts = Parts::with_grid(cpu(threads, tiles)?, Grid { y: *y, z: *z });
                    for (step, (got, wanted)) in run(&model, &parts)?.iter().zip(&wanted).enumerate() {
                        assert!(
                            got == wanted,
                            "{extents:?} {boundaries:?} {y}x{z} tiles of {tiles}, warms {warms}, step {step}"
                        );
                    }
                }
            }
        }
    }
    Ok(())
}

/// Late messages change when something is done, and nothing else.
#[test]
fn late_messages_change_no_bit() -> TestResult {
    for (extents, cut) in [([12, 9, 1], [3, 1]), ([7, 4, 4], [2, 2])] {
        let neighbourhood = if extents[2] > 1 { Neighbourhood::moore(1) } else { Neighbourhood::moore_2d(1) };
        let model = wood(extents, neighbourhood, Faces::all(Toroidal), true)?;
        let engine = Behind { engine: cpu(2, 4)?, manner: Manner::Late };
        let parts = Parts::with_grid(engine, Grid { y: cut[0], z: cut[1] });
        assert!(run(&model, &parts)? == run(&model, &Reference)?, "{extents:?}");
    }
    Ok(())
}

/// A glider crosses all cuts, and is all that is worked on.
#[test]
fn a_glider_goes_through_all_parts() -> TestResult {
    let model = life::glider(64)?;
    let parts = Parts::new(cpu(1, 8)?, count(3)?);
    let mut simulation = Simulation::new(&model, &parts, RunOptions::default())?;
    let first = simulation.state().read(life::Life::ALIVE)?;
    simulation.run(128)?;
    assert!(simulation.state().read(life::Life::ALIVE)? != first);
    simulation.run(128)?;
    assert!(simulation.state().read(life::Life::ALIVE)? == first);
    let figures = simulation.figures();
    for part in 0..3 {
        let name = format!("part_{part}_share_of_cells_worked_on");
        let figure = figures.iter().find(|figure| figure.name == name).ok_or("no share")?;
        // Five rows, each of which is at most three tiles of 8 cells, in the 21 rows of 64 that a part has,
        // and all cells in the first step. A glider is in a part for a third of the time, and some steps
        // more.
        let most = 1.0 / 256.0 + 5.0 * 24.0 / (21.0 * 64.0) * 0.5;
        assert!(figure.value < most && figure.value > 1.0 / 256.0, "{figure:?}, at most {most}");
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Load {
    weight: u32,
    share: u32,
}

#[elementary_process]
fn weigh(cell: &mut Cell<Load>) {
    if cell.weight >= 8 {
        cell.fault(8, cell.weight as Real);
    }
}

/// In the same stage as [`weigh`], and after it.
#[elementary_process]
fn divide(cell: &mut Cell<Load>) {
    cell.share = 100 / (7 - cell.weight.min(7));
}

/// In another stage.
#[elementary_process]
fn lean(cell: &mut Cell<Load>) {
    if cell.neighbour(1).share >= 50 {
        cell.fault(50, 0.0);
    }
    cell.weight = cell.neighbour(1).weight;
}

/// A fault in each of these cells of a space of six rows.
fn loads(weights: &'static [([usize; 3], u32)]) -> Result<Model, ModelError> {
    Model::builder("loads")
        .extents([5, 6, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(Toroidal)
        .substates::<Load>()
        .process((weigh, divide, lean))
        .fault_text(8, "too heavy")
        .fill(|site| {
            let weight =
                weights.iter().find(|(cell, _)| *cell == site.cell()).map_or(1, |(_, weight)| *weight);
            Load { weight, share: 0 }
        })
        .build()
}

/// The first fault by process, then cell, in whatever parts there are more of them.
#[test]
fn the_first_fault_of_all_parts() -> TestResult {
    const CASES: [&[([usize; 3], u32)]; 6] = [
        // At both edges of parts.
        &[([2, 3, 0], 8), ([4, 2, 0], 9)],
        &[([0, 5, 0], 9), ([0, 0, 0], 8)],
        // The earlier process has it in the later part.
        &[([1, 5, 0], 10), ([1, 0, 0], 7)],
        &[([1, 5, 0], 7), ([3, 1, 0], 6)],
        // A part sees it in a cell of another.
        &[([1, 3, 0], 5)],
        &[([4, 0, 0], 6)],
    ];
    let gpu = xca_tests::suite::engines::gpu()?;
    for weights in CASES {
        let model = loads(weights)?;
        let outcome = |engine: &dyn Engine| -> Result<_, Box<dyn Error>> {
            let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
            let error = simulation.run(9).expect_err("there is a fault");
            // The run ends, the state is still there, and a snapshot brings it back.
            simulation.state().read(Load::WEIGHT)?;
            Ok((error.to_string(), format!("{error:?}")))
        };
        let wanted = outcome(&Reference)?;
        for parts in [1, 2, 3, 6] {
            for tiles in [0, 1] {
                let engine = Parts::new(cpu(2, tiles)?, count(parts)?);
                assert_eq!(outcome(&engine)?, wanted, "{weights:?} in {parts} parts");
            }
        }
        let engine = Parts::new(gpu.clone(), count(2)?);
        assert_eq!(outcome(&engine)?, wanted, "{weights:?} in parts on a GPU");
    }
    Ok(())
}

/// After a fault a snapshot of an earlier step is gone on from, in parts as elsewhere.
#[test]
fn a_run_goes_on_after_a_fault() -> TestResult {
    let model = loads(&[([2, 3, 0], 8)])?;
    let sound = loads(&[])?;
    let options = RunOptions::default();
    let mut wanted = Simulation::new(&sound, &Reference, options)?;
    let snapshot = wanted.snapshot()?;
    wanted.run(4)?;
    let mut simulation = Simulation::new(&model, &Parts::new(cpu(1, 2)?, count(3)?), options)?;
    assert!(simulation.step().is_err());
    simulation.restore(&snapshot)?;
    simulation.run(4)?;
    assert!(simulation.snapshot()?.groups == wanted.snapshot()?.groups);
    Ok(())
}

/// Where the border of a part fails or panics, all parts end, and the reason is told. None waits.
#[test]
fn a_part_that_cannot_go_on_ends_all() -> TestResult {
    let model = wood([6, 8, 1], Neighbourhood::moore_2d(1), Faces::all(Toroidal), true)?;
    for (number, y) in [0, 2, 6].into_iter().enumerate() {
        for uses in [1, 2, 3, 5, 8, 40] {
            for (manner, words) in [
                (Manner::Fails { y, uses }, "as planned"),
                (Manner::Panics { y, uses }, "it panicked: as it was planned"),
            ] {
                let engine = Behind { engine: cpu(1, 1)?, manner };
                let parts = Parts::new(engine, count(4)?);
                let mut simulation = Simulation::new(&model, &parts, RunOptions::default())?;
                let error = simulation.run(100).expect_err("a part cannot go on").to_string();
                let part = [0, 1, 3][number];
                assert!(error.contains(&format!("part {part}: ")) && error.contains(words), "{error}");
                let again = simulation.state().read(Site::FUEL).expect_err("no part goes on").to_string();
                assert!(again.contains(words), "{again}");
            }
        }
    }
    Ok(())
}

/// What cannot be cut is refused before anything runs.
#[test]
fn what_cannot_be_cut_is_refused() -> TestResult {
    let refused = |model: &Model, parts: &Parts| {
        let result = parts.start(model, Precision::F64);
        result.err().map(|error| error.to_string()).ok_or("it is not refused")
    };
    let model = wood([9, 8, 5], Neighbourhood::moore(2), Faces::all(Flat), false)?;
    let message = refused(&model, &Parts::new(cpu(1, 0)?, count(9)?))?;
    assert!(message.contains("at most 4 parts fit along y and 2 along z"), "{message}");
    let message = refused(&model, &Parts::with_grid(cpu(1, 0)?, Grid { y: 5, z: 1 }))?;
    let wanted =
        "cannot be cut into 5 parts along y and 1 along z; the model reaches so far that at most 4 parts";
    assert!(message.contains(wanted), "{message}");
    let message = refused(&model, &Parts::with_grid(cpu(1, 0)?, Grid { y: 2, z: 0 }))?;
    assert!(message.contains("at least one part"), "{message}");
    let message = refused(&model, &Parts::new(Reference, count(2)?))?;
    assert!(message.contains("the reference engine cannot run a part of the space"), "{message}");
    Ok(())
}

/// A border that leads nowhere.
struct NoBorder;

impl xca_core::engine::Border for NoBorder {
    fn send(&mut self, _face: Face, _bytes: Vec<u8>) -> Result<(), EngineFailure> {
        Ok(())
    }

    fn receive(&mut self, _face: Face) -> Result<Vec<u8>, EngineFailure> {
        Ok(vec![0; 3])
    }

    fn give_up(&mut self) -> Result<(), EngineFailure> {
        Ok(())
    }

    fn least(&mut self, number: u64) -> Result<u64, EngineFailure> {
        Ok(number)
    }
}

/// A part has its own cells, by their numbers in the whole space, and takes no others.
#[test]
fn a_part_knows_its_cells() -> TestResult {
    let model = loads(&[])?;
    let start = |part: Part| {
        cpu(1, 1)?
            .start_part(&model, Precision::F64, &part, Box::new(NoBorder))
            .map_err(Box::<dyn Error>::from)
    };
    let weight = SubstateId { group: 0, field: 0 };
    let mut part = start(Part { y: 2..4, z: 0..1 })?;
    let values: Vec<u8> = (0..10_u32).flat_map(u32::to_ne_bytes).collect();
    part.write(weight, &values)?;
    assert_eq!(part.read(weight)?, values);
    assert_eq!(part.read_cells(weight, &[19, 10])?, [9_u32, 0].map(u32::to_ne_bytes).concat());
    part.write_cells(weight, &[11], &7_u32.to_ne_bytes())?;
    assert_eq!(part.read(weight)?[4..8], 7_u32.to_ne_bytes());
    for cell in [9, 20, 0, 29] {
        let wanted = EngineFailure::Input(InputError::NotInPart { cell, y: 2..4, z: 0..1 });
        assert_eq!(part.read_cells(weight, &[12, cell]), Err(wanted.clone()));
        assert_eq!(part.write_cells(weight, &[cell], &[0; 4]), Err(wanted));
    }
    assert!(matches!(
        part.write(weight, &[0; 120]),
        Err(EngineFailure::Input(InputError::WrongLength { .. }))
    ));
    part.write(weight, &[0; 40])?;
    // A neighbour of another build sends something else.
    let mut values = model.parameters().clone();
    values.set_bits(&[]);
    let context = xca_core::engine::StepContext { step: 0, seed: 1, parameters: &[], values: &values };
    let fault = part.run(0..3, &context).expect_err("the edge is too short");
    assert!(matches!(&fault, Fault::Engine(EngineFailure::Broken { .. })), "{fault}");
    let beyond =
        cpu(1, 1)?.start_part(&model, Precision::F64, &Part { y: 2..7, z: 0..1 }, Box::new(NoBorder));
    assert!(matches!(beyond, Err(StartError::Part(_))));
    Ok(())
}
