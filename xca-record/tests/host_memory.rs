//! The host writes frames, pictures and observables of cells without the memory for a whole state.
//!
//! The parts are threads of this process, so its memory is that of the parts and of the host. It is the only
//! test here, because tests of one process share its memory.

use std::error::Error;
use std::fs;
use std::path::Path;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_parts::{Balance, Grid, Parts};
use xca_record::{Run, SetUp};

#[derive(Substates, Clone, Copy)]
struct Rock {
    heat: f64,
    stress: [f64; 7],
    molten: bool,
}

#[elementary_process]
fn melt(cell: &mut Cell<Rock>) {
    cell.heat += 1.5;
    cell.molten = cell.heat > 100.0;
}

const EXTENTS: [usize; 3] = [128, 64, 128];

/// The bytes of the state.
const STATE: u64 = 65 << 20;

/// What blocks of 4 MiB may take: the bytes in each part, in messages, and those gathered.
const ROOM: u64 = 32 << 20;

/// The most memory that this process has had. `None` on systems that do not tell it.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}

fn record(engine: &dyn Engine, out: &Path) -> Result<(), Box<dyn Error + Send + Sync>> {
    let at = |cell: [usize; 3]| (cell[0] * 31 + cell[1] * 17 + cell[2]) as f64;
    let model = Model::builder("rock")
        .extents(EXTENTS)
        .substates::<Rock>()
        .process(melt)
        .fill(move |site| Rock { heat: at(site.cell()) % 201.0, stress: [at(site.cell()); 7], molten: false })
        .build()?;
    Run::new(SetUp::new(model, 2))?.every(1).begin(out, engine)?.go(&mut ())?;
    Ok(())
}

#[test]
fn the_host_needs_no_memory_for_a_whole_state() -> Result<(), Box<dyn Error + Send + Sync>> {
    let Some(start) = peak() else { return Ok(()) };
    let folder = tempfile::tempdir()?;
    let [of_parts, of_one] = ["parts", "one"].map(|name| folder.path().join(name));
    let parts = Parts::with_grid(Cpu::with_threads(1)?, Grid { y: 2, z: 1 }).with_balance(Balance::NEVER);
    record(&parts, &of_parts)?;
    let taken = peak().ok_or("no peak")? - start;
    assert!(taken > STATE / 2, "{taken} bytes are less than the state");
    assert!(taken <= STATE + ROOM, "the run took {taken} bytes");
    record(&Reference, &of_one)?;
    for file in ["observables.csv", "initial.png", "final.png", "frames/rock_00000002.vti"] {
        assert!(fs::read(of_parts.join(file))? == fs::read(of_one.join(file))?, "{file}");
    }
    Ok(())
}
