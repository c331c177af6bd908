//! The host makes items, writes checkpoints of them and resumes from these without the memory for all items.
//!
//! The parts are threads of this process, so its memory is that of the parts and of the host. It is the only
//! test here, because tests of one process share its memory.

use std::error::Error;
use std::fs;
use xca_checkpoint::{CheckpointFile, CheckpointFolder, Description, Identity, Origin, Outputs, Recorded};
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_io::atomic::OutputFolder;
use xca_parts::{Balance, Grid, Parts};

#[derive(Substates, Clone, Copy)]
struct Grain {
    mass: f64,
    stress: [f64; 7],
}

const EXTENTS: [usize; 3] = [64, 64, 64];

/// The items of a cell, and the bytes of all with their labels.
const IN_CELL: usize = 4;
const ITEMS: u64 = 68 << 20;

/// What blocks may take, in parts, in messages, gathered or scattered; and memory of the first simulation
/// that the system has not got back when the second one begins. All items at the host would take twice as
/// much.
const ROOM: u64 = 92 << 20;

/// The most memory that this process has had. `None` on systems that do not tell it.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}

#[test]
fn the_host_needs_no_memory_for_all_items() -> Result<(), Box<dyn Error>> {
    let Some(start) = peak() else { return Ok(()) };
    let model = Model::builder("sand")
        .extents(EXTENTS)
        .population::<Grain>(IN_CELL)
        .populate(|site| [Grain { mass: site.cell()[2] as f64, stress: [site.random(0); 7] }; IN_CELL])
        .build()?;
    let parts = Parts::with_grid(Cpu::with_threads(1)?, Grid { y: 2, z: 1 }).with_balance(Balance::NEVER);
    let mut simulation = Simulation::new(&model, &parts, RunOptions::default())?;
    // The state, and what each part collects before it takes it over.
    let memory = simulation.memory() as u64 + ITEMS;
    assert!(memory > 2 * ITEMS);
    let made = peak().ok_or("no peak")? - start;
    assert!(made <= memory + ROOM, "making them took {made} bytes");

    let folder = tempfile::tempdir()?;
    let options = simulation.options();
    let run = Origin::new(&Identity::default(), &model, &[], options, 10, Outputs::Every(2));
    let outline = simulation.outline();
    let description = Description::new(run, &model, None, 0.0, &outline, Recorded::default());
    let mut checkpoints = CheckpointFolder::create(&OutputFolder::create(folder.path())?, None)?;
    checkpoints.write(&description, &simulation)?;
    let [path] = &CheckpointFolder::of_run(folder.path())[..] else { return Err("no checkpoint".into()) };
    let written = peak().ok_or("no peak")? - start;
    assert!(written <= memory + ROOM, "the checkpoint took {written} bytes");

    let wanted = simulation.state().sum(Grain::MASS)?;
    drop(simulation);
    let mut simulation = CheckpointFile::open(path)?.resume(&model, &parts, options)?;
    assert_eq!(simulation.state().sum(Grain::MASS)?, wanted);
    let resumed = peak().ok_or("no peak")? - start;
    assert!(resumed <= memory + ROOM, "resuming took {resumed} bytes");

    // All items at the host show in this figure.
    let snapshot = simulation.snapshot()?;
    let held = peak().ok_or("no peak")? - start;
    assert!(held > memory + ROOM, "a snapshot of {} groups took {held} bytes", snapshot.groups.len());
    Ok(())
}
