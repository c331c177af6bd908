//! The host fills cells, writes checkpoints and resumes from them without the memory for a whole state.
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
struct Rock {
    heat: f64,
    stress: [f64; 7],
}

const EXTENTS: [usize; 3] = [128, 64, 128];

/// The bytes of the state.
const STATE: u64 = 64 << 20;

/// What blocks of 4 MiB may take: the bytes in each part, in messages, and those gathered or scattered.
const ROOM: u64 = 32 << 20;

/// The most memory that this process has had. `None` on systems that do not tell it.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}

#[test]
fn the_host_needs_no_memory_for_a_whole_state() -> Result<(), Box<dyn Error>> {
    let Some(start) = peak() else { return Ok(()) };
    let model = Model::builder("rock")
        .extents(EXTENTS)
        .substates::<Rock>()
        .fill(|site| Rock { heat: site.cell()[2] as f64, stress: [site.cell()[1] as f64; 7] })
        .build()?;
    let parts = Parts::with_grid(Cpu::with_threads(1)?, Grid { y: 2, z: 1 }).with_balance(Balance::NEVER);
    let mut simulation = Simulation::new(&model, &parts, RunOptions::default())?;
    assert!(simulation.memory() as u64 >= STATE);
    let filled = peak().ok_or("no peak")? - start;
    assert!(filled <= STATE + ROOM, "filling took {filled} bytes");

    let folder = tempfile::tempdir()?;
    let options = simulation.options();
    let run = Origin::new(&Identity::default(), &model, &[], options, 10, Outputs::Every(2));
    let outline = simulation.outline();
    let description = Description::new(run, &model, None, 0.0, &outline, Recorded::default());
    let mut checkpoints = CheckpointFolder::create(&OutputFolder::create(folder.path())?, None)?;
    checkpoints.write(&description, &simulation)?;
    let [path] = &CheckpointFolder::of_run(folder.path())[..] else { return Err("no checkpoint".into()) };
    assert!(fs::metadata(path)?.len() > STATE);
    let written = peak().ok_or("no peak")? - start;
    assert!(written <= STATE + ROOM, "the checkpoint took {written} bytes");

    let wanted = simulation.state().sum(Rock::HEAT)?;
    drop(simulation);
    let mut simulation = CheckpointFile::open(path)?.resume(&model, &parts, options)?;
    assert_eq!(simulation.state().sum(Rock::HEAT)?, wanted);
    let resumed = peak().ok_or("no peak")? - start;
    assert!(resumed <= STATE + ROOM, "resuming took {resumed} bytes");

    // A whole state shows in this figure.
    let snapshot = simulation.snapshot()?;
    let held = peak().ok_or("no peak")? - start;
    assert!(
        held > STATE + ROOM + STATE / 2,
        "a snapshot of {} groups took {held} bytes",
        snapshot.groups.len()
    );
    Ok(())
}
