//! The host writes frames and tables of items without the memory for all of them.
//!
//! The parts are threads of this process, so its memory is that of the parts and of the host. It is the only
//! test here, because tests of one process share its memory.

use std::error::Error;
use std::fs;
use std::path::Path;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_parts::{Balance, Grid, Parts};
use xca_record::{ItemView, Run, SetUp};

#[derive(Substates, Clone, Copy)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    stress: [f64; 8],
    kind: u8,
}

const EXTENTS: [usize; 3] = [64, 64, 48];

/// The items of a cell, and the bytes of all with their labels and cells.
const IN_CELL: usize = 3;
const ITEMS: u64 = 97 * 3 * 64 * 64 * 48;

/// What blocks may take, in parts, in messages and at the host. All items at the host take twice as much.
const ROOM: u64 = 88 << 20;

/// The most memory that this process has had. `None` on systems that do not tell it.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}

/// Returns the memory of the state in bytes.
fn record(engine: &dyn Engine, out: &Path) -> Result<u64, Box<dyn Error + Send + Sync>> {
    let grain = |site: Site, number: usize| Grain {
        position: site.centre(),
        stress: [site.random(number); 8],
        kind: (site.cell()[0] % 4) as u8,
    };
    let model = Model::builder("sand")
        .extents(EXTENTS)
        .population::<Grain>(IN_CELL)
        .populate(move |site| (0..IN_CELL).map(move |number| grain(site, number)))
        .build()?;
    let stress = ["a", "b", "c", "d", "e", "f", "g", "h"];
    let view = ItemView::<Grain>::named("sand").only(Grain::KIND, 3);
    let view = view.columns(Grain::KIND, ["kind"]).columns(Grain::STRESS, stress);
    let mut set_up = SetUp::new(model, 1).items(view);
    set_up.formats.choose(&["vtk", "csv", "xyz"])?;
    let mut recording = Run::new(set_up)?.every(1).begin(out, engine)?;
    recording.go(&mut ())?;
    Ok(recording.simulation().memory() as u64)
}

#[test]
fn the_host_needs_no_memory_for_all_items() -> Result<(), Box<dyn Error + Send + Sync>> {
    let Some(start) = peak() else { return Ok(()) };
    let folder = tempfile::tempdir()?;
    let [of_parts, of_one] = ["parts", "one"].map(|name| folder.path().join(name));
    let parts = Parts::with_grid(Cpu::with_threads(1)?, Grid { y: 2, z: 1 }).with_balance(Balance::NEVER);
    let state = record(&parts, &of_parts)?;
    let taken = peak().ok_or("no peak")? - start;
    // Parts hold their items once more when they begin, and when they sort them by label.
    assert!(taken > state && state > ITEMS, "{taken} bytes are less than the state");
    assert!(taken <= state + 2 * ITEMS + ROOM, "the run took {taken} bytes");
    record(&Reference, &of_one)?;
    for file in ["frames/sand_00000001.vtp", "frames/sand_00000001.xyz", "final.csv"] {
        assert!(fs::read(of_parts.join(file))? == fs::read(of_one.join(file))?, "{file}");
    }
    Ok(())
}
