//! Parts of a space give their state in blocks of rows, and take cells so. The bytes are those of one engine.

use std::error::Error;
use std::fs;
use std::path::Path;
use xca_checkpoint::{Checkpoint, CheckpointFolder, Description, Identity, Origin, Outputs, Recorded};
use xca_core::engine::Plane;
use xca_core::prelude::*;
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
            let read = Checkpoint::read(&CheckpointFolder::of_run(&run)[0])?;
            let resumed = Simulation::resume(&model, &parts([1, 2])?, options, &read.snapshot)?;
            assert!(resumed.snapshot()? == reference.snapshot()?, "{precision} {cut:?}");
        }
    }
    Ok(())
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

/// A host holds the whole state for each output, so a program refuses a model by all of its cells.
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
