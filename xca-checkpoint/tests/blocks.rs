//! Parts of a space give their state in blocks of rows, and take it so. The bytes are those of one engine,
//! and a run goes on from them on any.

use std::error::Error;
use std::fs;
use std::path::Path;
use xca_checkpoint::{
    Checkpoint, CheckpointFile, CheckpointFolder, Description, Identity, Origin, Outputs, Recorded,
};
use xca_core::engine::{LabelledItems, Plane, SubstateId};
use xca_core::prelude::*;
use xca_core::{EngineFailure, GroupSnapshot, Outline};
use xca_cpu::Cpu;
use xca_io::atomic::OutputFolder;
use xca_parts::{Balance, Grid, Parts};

type TestResult = Result<(), Box<dyn Error>>;

#[derive(Substates, Clone, Copy)]
struct Ground {
    height: Real,
    slope: Vector2<Real>,
    layers: [Real; 3],
    is_wet: bool,
}

#[derive(Substates, Clone, Copy)]
struct Stone {
    #[position]
    position: Vector3<Real>,
    mass: Real,
    hops: u32,
}

#[elementary_process]
fn sink(ground: &mut Cell<Ground>) {
    ground.height = 0.5 * ground.neighbour(1).height + 0.25 * ground.neighbour(4).height;
    ground.layers[1] += ground.height;
    ground.is_wet = ground.height > 3.0;
}

#[elementary_process]
fn hop(stone: &mut Slot<Stone>, space: &Space) {
    let way = Vector3::new(0.3, 0.9, 0.7) * (0.5 + 0.5 * stone.mass);
    stone.position = space.wrapped(stone.position + way);
    stone.hops += 1;
}

#[migration]
fn settle(stone: &Slot<Stone>, space: &Space) -> Destination {
    space.cell_containing(stone.position)
}

const EXTENTS: [usize; 3] = [7, 6, 5];

/// Most rows have no stones, some have many.
fn slope() -> Result<Model, ModelError> {
    Model::builder("slope")
        .extents(EXTENTS)
        .neighbourhood(Neighbourhood::moore(1))
        .boundary(Boundary::Toroidal)
        .substates::<Ground>()
        .population::<Stone>(8)
        .process((sink, hop, settle))
        .fill(|site| {
            let [x, y, z] = site.cell().map(|index| index as f64);
            Ground {
                height: x + 0.1 * y + 0.01 * z + site.random(0),
                slope: Vector2::new(y, -z),
                layers: [z, y, x],
                is_wet: site.cell()[1] == 2,
            }
        })
        .populate(|site| {
            let [x, y, z] = site.cell();
            let count = if y == 3 || (x + z) % 5 == 0 { x % 4 } else { 0 };
            (0..count).map(move |number| Stone {
                position: site.centre(),
                mass: 0.2 * number as f64 + 0.1 * site.random(number),
                hops: 0,
            })
        })
        .build()
}

/// Planes with their bytes.
type PlaneBytes = Vec<(Plane, Vec<u8>)>;

/// The planes of a simulation, read in blocks of up to so many bytes, and the largest block.
fn planes(simulation: &Simulation, size: usize) -> Result<(PlaneBytes, usize), RunError> {
    let mut planes = PlaneBytes::new();
    let mut largest = 0;
    simulation.read_blocks(size, |plane, block| {
        largest = largest.max(block.len());
        match planes.last_mut() {
            Some((last, bytes)) if *last == plane => bytes.extend_from_slice(block),
            _ => planes.push((plane, block.to_vec())),
        }
        Ok::<(), RunError>(())
    })?;
    Ok((planes, largest))
}

/// The parts along y and z.
const CUTS: [[usize; 2]; 6] = [[1, 1], [2, 1], [3, 1], [1, 2], [1, 3], [2, 2]];

fn parts([y, z]: [usize; 2]) -> Result<Parts, Box<dyn Error>> {
    Ok(Parts::with_grid(Cpu::with_threads(1)?, Grid { y, z }).with_balance(Balance::NEVER))
}

/// Enough for every row of the model, of cells and of stones.
const LONGEST_ROW: usize = 7 * 8 * 24;

#[test]
fn blocks_of_any_size_make_the_planes() -> TestResult {
    let model = slope()?;
    for precision in [Precision::F32, Precision::F64] {
        let options = RunOptions { precision, seed: 7 };
        let mut wanted = Simulation::new(&model, &Reference, options)?;
        let mut simulations = Vec::new();
        for cut in CUTS {
            simulations.push((format!("{cut:?}"), Simulation::new(&model, &parts(cut)?, options)?));
        }
        simulations.push(("cpu".to_owned(), Simulation::new(&model, &Cpu::with_threads(2)?, options)?));
        for step in 0..3 {
            // The reference gives whole planes.
            let (whole, _) = planes(&wanted, 1)?;
            assert_eq!(whole.len(), 4 + 2 + 3);
            for (name, simulation) in &simulations {
                assert_eq!(simulation.outline(), wanted.outline(), "{name} {precision} {step}");
                for size in [1, 100, 999, LONGEST_ROW, usize::MAX] {
                    let (got, largest) = planes(simulation, size)?;
                    assert!(got == whole, "{name} {precision}, step {step}, blocks of {size}");
                    assert!(largest <= size.max(LONGEST_ROW), "{largest} bytes in a block of {size}");
                }
            }
            wanted.run(2)?;
            simulations.iter_mut().try_for_each(|(_, simulation)| simulation.run(2).map(drop))?;
        }
    }
    Ok(())
}

fn description(simulation: &Simulation) -> Description {
    let (model, options) = (simulation.model(), simulation.options());
    let run = Origin::new(&Identity::default(), model, &[], options, 10, Outputs::Every(2));
    Description::new(run, model, None, 0.5, &simulation.outline(), Recorded::default())
}

/// The bytes of the checkpoint of a simulation.
fn checkpoint(simulation: &Simulation, run: &Path) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut folder = CheckpointFolder::create(&OutputFolder::create(run)?, None)?;
    folder.write(&description(simulation), simulation)?;
    let [path] = &CheckpointFolder::of_run(run)[..] else { return Err("no checkpoint".into()) };
    Ok(fs::read(path)?)
}

#[test]
fn checkpoints_of_parts_are_those_of_one_engine() -> TestResult {
    let model = slope()?;
    let folder = tempfile::tempdir()?;
    for precision in [Precision::F32, Precision::F64] {
        let options = RunOptions { precision, seed: 3 };
        let mut reference = Simulation::new(&model, &Reference, options)?;
        reference.run(3)?;
        // Of a whole snapshot.
        let path = folder.path().join(format!("{precision}.checkpoint"));
        let snapshot = reference.snapshot()?;
        Checkpoint { description: description(&reference), snapshot }.write(&path)?;
        let wanted = fs::read(&path)?;
        for cut in CUTS {
            let mut simulation = Simulation::new(&model, &parts(cut)?, options)?;
            simulation.run(3)?;
            let run = folder.path().join(format!("{precision} {cut:?}"));
            assert!(checkpoint(&simulation, &run)? == wanted, "{precision} {cut:?}");
            let path = &CheckpointFolder::of_run(&run)[0];
            let file = CheckpointFile::open(path)?;
            assert_eq!(*file.description(), description(&reference));
            for on in CUTS {
                let resumed = file.resume(&model, &parts(on)?, options)?;
                assert!(resumed.snapshot()? == reference.snapshot()?, "{precision} {cut:?} on {on:?}");
            }
            assert!(file.resume(&model, &Reference, options)?.snapshot()? == reference.snapshot()?);
            assert!(Checkpoint::read(path)?.snapshot == reference.snapshot()?, "{precision} {cut:?}");
        }
    }
    Ok(())
}

/// A simulation in the state of these planes, read in blocks of up to so many bytes, and the largest block.
fn resumed(
    (model, engine, options): (&Model, &dyn Engine, RunOptions),
    outline: &Outline,
    planes: &PlaneBytes,
    size: usize,
) -> Result<(Simulation, usize), RunError> {
    let (mut done, mut largest) = ((0, 0), 0);
    let read = |plane: Plane, block: &mut [u8]| {
        let (place, start) = done;
        let (wanted, bytes) = &planes[place];
        assert_eq!(plane, *wanted);
        let end = start + block.len();
        block.copy_from_slice(&bytes[start..end]);
        done = if end == bytes.len() { (place + 1, 0) } else { (place, end) };
        largest = largest.max(block.len());
        Ok::<(), RunError>(())
    };
    let simulation = Simulation::resume_blocks(model, engine, options, outline, size, read)?;
    assert_eq!(done, (planes.len(), 0));
    Ok((simulation, largest))
}

#[test]
fn a_run_goes_on_from_blocks_of_any_size() -> TestResult {
    let model = slope()?;
    for precision in [Precision::F32, Precision::F64] {
        let options = RunOptions { precision, seed: 7 };
        let mut first = Simulation::new(&model, &Reference, options)?;
        first.run(3)?;
        let (outline, (planes, _)) = (first.outline(), planes(&first, 1)?);
        first.run(2)?;
        let mut engines: Vec<(String, Box<dyn Engine>)> = vec![("reference".to_owned(), Box::new(Reference))];
        engines.push(("cpu".to_owned(), Box::new(Cpu::with_threads(2)?)));
        for cut in CUTS {
            engines.push((format!("{cut:?}"), Box::new(parts(cut)?)));
        }
        for (name, engine) in &engines {
            for size in [1, 100, 999, usize::MAX] {
                let (mut simulation, _) = resumed((&model, &**engine, options), &outline, &planes, size)?;
                assert_eq!(simulation.outline(), outline);
                simulation.run(2)?;
                assert!(simulation.snapshot()? == first.snapshot()?, "{name} {precision}, blocks of {size}");
            }
        }
    }
    Ok(())
}

#[derive(Substates, Clone, Copy)]
struct Water {
    depth: [Real; 3],
}

/// Neither items, whether they come from a checkpoint or are set anew.
#[test]
fn parts_take_items_in_blocks() -> TestResult {
    let model = slope()?;
    let options = RunOptions::default();
    let mut reference = Simulation::new(&model, &Reference, options)?;
    let (outline, (planes, _)) = (reference.outline(), planes(&reference, 1)?);
    // The cells of a row, or 15 stones in the fullest, each with a position.
    let (_, largest) = resumed((&model, &parts([2, 2])?, options), &outline, &planes, 1)?;
    assert!(largest < 500, "{largest}");
    let (_, whole) = resumed((&model, &Reference, options), &outline, &planes, 1)?;
    assert!(whole > 2000, "{whole}");
    reference.run(4)?;
    let stones: Vec<Item<Stone>> = reference.state().items()?;
    for cut in CUTS {
        let mut simulation = Simulation::new(&model, &parts(cut)?, options)?;
        // In any order.
        simulation.state().set_items(stones.iter().rev().cloned().collect())?;
        assert!(simulation.snapshot()?.groups[1] == reference.snapshot()?.groups[1], "{cut:?}");
        let full = |site: &Site| if site.cell() == [3, 5, 4] { 9 } else { 1 };
        let stone = |site: Site| vec![Stone { position: site.centre(), mass: 1.0, hops: 0 }; full(&site)];
        let error = simulation.state().populate(stone).unwrap_err().to_string();
        let wanted = Simulation::new(&model, &Reference, options)?.state().populate(stone).unwrap_err();
        assert_eq!(error, wanted.to_string());
        assert!(simulation.snapshot()?.groups[1] == reference.snapshot()?.groups[1], "{cut:?}: as before");
    }
    Ok(())
}

/// A host needs no more of the cells at once than a block, or a row.
#[test]
fn parts_take_cells_in_blocks() -> TestResult {
    let model = Model::builder("lake").extents([7, 6, 5]).substates::<Water>().build()?;
    let options = RunOptions::default();
    let outline = Simulation::new(&model, &Reference, options)?.outline();
    let planes = vec![(Plane::Values(SubstateId { group: 0, field: 0 }), vec![0; 7 * 6 * 5 * 24])];
    let largest = |engine: &dyn Engine, size: usize| -> Result<usize, RunError> {
        resumed((&model, engine, options), &outline, &planes, size).map(|(_, largest)| largest)
    };
    for engine in [&parts([2, 2])? as &dyn Engine, &Cpu::with_threads(1)?] {
        let wanted = [7 * 24, 7 * 24, 2 * 7 * 24, 7 * 6 * 5 * 24];
        for (size, wanted) in [1, 335, 336, usize::MAX].into_iter().zip(wanted) {
            assert_eq!(largest(engine, size)?, wanted, "{size}");
        }
    }
    assert_eq!(largest(&Reference, 1)?, 7 * 6 * 5 * 24, "takes whole planes");
    Ok(())
}

/// What was collected before row 0 counts no more, and what does not fit changes nothing.
#[test]
fn items_are_collected_anew() -> TestResult {
    let model = slope()?;
    let reference = Simulation::new(&model, &Reference, RunOptions::default())?;
    let (planes, _) = planes(&reference, usize::MAX)?;
    let mut execution = parts([2, 1])?.start(&model, Precision::F64)?;
    let of_stones = || planes.iter().filter(|(plane, _)| plane.group() == 1);
    for _ in 0..2 {
        for (plane, bytes) in of_stones() {
            assert!(execution.collect_items(*plane, 0..30, bytes)?);
            let error = execution.collect_items(*plane, 0..30, &bytes[4..]);
            assert!(matches!(error, Err(EngineFailure::Input(_))), "{plane:?}: {error:?}");
            assert!(execution.collect_items(*plane, 0..30, bytes)?);
        }
    }
    assert_eq!(execution.items(1), 0);
    execution.set_collected_items(1)?;
    assert_eq!(Some(execution.items(1)), reference.outline().populations[1].map(|counts| counts.items));
    let stones = GroupSnapshot::Population(execution.population(1)?, 0);
    assert!(stones == reference.snapshot()?.groups[1]);
    // They also come by label, in any ranges.
    let all = LabelledItems::of(execution.population(1)?, &[24, 8, 4], |cell| cell as u32);
    assert_eq!(execution.label_counts(1)?, Some(all.counts()));
    assert_eq!(execution.label_counts(0)?, None, "cells have no labels");
    for labels in [0..1, 3..17, 17..1 << 32, 0..1 << 32] {
        assert!(execution.labelled_items(1, labels.clone())? == all.within(labels.clone(), &[24, 8, 4]));
        let wanted = all.labels.iter().filter(|label| labels.contains(&u64::from(**label))).count();
        assert_eq!(execution.labelled_items(1, labels.clone())?.labels.len(), wanted, "{labels:?}");
    }
    Ok(())
}

/// Files have items by label: the same after each step, though parts keep what they have sorted.
#[test]
fn items_come_by_label() -> TestResult {
    let model = slope()?;
    let by_label = |simulation: &Simulation| -> Result<LabelledItems, EngineFailure> {
        let mut blocks = Vec::new();
        simulation.read_items(1, |items| {
            blocks.push(items);
            Ok::<(), EngineFailure>(())
        })?;
        Ok(LabelledItems::merged(blocks, &[24, 8, 4]))
    };
    let mut reference = Simulation::new(&model, &Reference, RunOptions::default())?;
    let mut all = Vec::new();
    for cut in CUTS {
        all.push(Simulation::new(&model, &parts(cut)?, RunOptions::default())?);
    }
    for step in 0..4 {
        let stones: Vec<Item<Stone>> = reference.state().items()?;
        let wanted = by_label(&reference)?;
        assert!(wanted.labels.is_sorted() && wanted.labels.len() == stones.len());
        for stone in stones {
            let place = wanted.labels.binary_search(&stone.label).unwrap();
            assert_eq!(wanted.cells[place] as usize, model.geometry().linear(stone.cell));
            assert_eq!(wanted.fields[1][8 * place..8 * place + 8], stone.state.mass.to_ne_bytes());
        }
        for simulation in &mut all {
            assert!(by_label(simulation)? == wanted, "step {step}");
            assert!(by_label(simulation)? == wanted, "step {step}, again");
            simulation.run(1)?;
        }
        reference.run(1)?;
    }
    Ok(())
}

/// Whatever an engine relies on is checked, and the message tells what is wrong.
#[test]
fn planes_of_another_state_are_refused() -> TestResult {
    let model = slope()?;
    let options = RunOptions::default();
    let first = Simulation::new(&model, &Reference, options)?;
    let (outline, (planes, _)) = (first.outline(), planes(&first, 1)?);
    let refused = |outline: &Outline, planes: &PlaneBytes| -> Result<(), Box<dyn Error>> {
        for engine in [&Reference as &dyn Engine, &Cpu::with_threads(2)?, &parts([2, 2])?] {
            let result = resumed((&model, engine, options), outline, planes, 100);
            let name = engine.name();
            let Err(error) = result else { return Err(format!("{name} takes it").into()) };
            assert!(matches!(error, RunError::Snapshot(_)), "{name}: {error}");
        }
        Ok(())
    };
    let changed = |place: usize, byte: usize, to: u8| {
        let mut planes = planes.clone();
        planes[place].1[byte] = to;
        planes
    };
    refused(&outline, &changed(3, 20, 2))?;
    // More stones in a cell than there are, and a label twice.
    refused(&outline, &changed(4, 0, 7))?;
    let label = planes[5].1[0];
    refused(&outline, &changed(5, 4, label))?;
    // The labels of a cell in another order.
    let mut reversed = planes.clone();
    reversed[5].1 = planes[5].1.as_chunks::<4>().0.iter().rev().copied().collect::<Vec<_>>().into_flattened();
    refused(&outline, &reversed)?;
    refused(&Outline { broken: true, ..outline.clone() }, &planes)?;
    refused(&Outline { populations: vec![None; 2], ..outline.clone() }, &planes)?;
    refused(&Outline { populations: Vec::new(), ..outline.clone() }, &planes)?;
    refused(&Outline { parameters: vec![vec![0]], ..outline }, &planes)
}

/// `fill` replaces all cells in a later step too.
#[test]
fn cells_are_filled_again() -> TestResult {
    let model = slope()?;
    let again = |engine: &dyn Engine| -> Result<_, Box<dyn Error>> {
        let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
        simulation.run(2)?;
        simulation.state().fill(|site| Ground {
            height: site.random(1),
            slope: Vector2::new(0.0, 1.0),
            layers: [site.random(2); 3],
            is_wet: false,
        })?;
        let filled = simulation.snapshot()?;
        simulation.run(2)?;
        Ok([filled, simulation.snapshot()?])
    };
    let wanted = again(&Reference)?;
    assert!(again(&Cpu::with_threads(2)?)? == wanted);
    for cut in CUTS {
        assert!(again(&parts(cut)?)? == wanted, "{cut:?}");
    }
    Ok(())
}

/// The parts are in one process, so a program refuses a model by all of its cells.
#[test]
fn the_least_memory_counts_all_cells() -> TestResult {
    let model = Model::builder("wide").extents([64, 30, 20]).substates::<Ground>().build()?;
    for (precision, size) in [(Precision::F32, 25), (Precision::F64, 49)] {
        for cut in CUTS {
            let parts = parts(cut)?;
            let announced = parts.least_memory(&model, precision);
            let options = RunOptions { precision, seed: 0 };
            let taken = Simulation::new(&model, &parts, options)?.memory() as u128;
            assert!(announced >= 64 * 30 * 20 * size, "{cut:?}: {announced} bytes");
            assert!(announced <= taken, "{cut:?}: {announced} bytes are announced, {taken} taken");
        }
    }
    Ok(())
}
