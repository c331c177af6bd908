//! A plate that cools down, recorded in a folder; a run that was killed goes on from its last checkpoint.

use std::path::Path;
use xca::Cpu;
use xca::io::ascii_grid;
use xca::io::raster::Raster;
use xca::prelude::*;
use xca::record::{CellView, Failure, Interval, Run, SetUp};

#[derive(Substates, Clone)]
struct Plate {
    temperature: Real,
}

#[elementary_process]
fn conduct(cell: &mut Cell<Plate>) {
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        sum += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature += 0.2 * sum;
}

fn main() -> Result<(), Failure> {
    let out = std::env::args().nth(1).unwrap_or_else(|| "out/plate".to_owned());
    let model = Model::builder("plate")
        .extents([64, 64, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .substates::<Plate>()
        .process(conduct)
        .fill(|site| Plate { temperature: if site.cell()[0] < 32 { 100.0 } else { 0.0 } })
        .build()?;
    let view = CellView::named("plate").draw(Plate::TEMPERATURE, "temperature (K)");
    let run =
        Run::new(SetUp::new(model, 1000).cells(view))?.every(100).checkpoint_every(Interval::Steps(250));
    let mut recording = run.resume_or_begin(&out, &Cpu::new()?)?;
    recording.go(&mut ())?;
    let temperatures = recording.into_simulation().state().read(Plate::TEMPERATURE)?;
    let grid = Raster::new([64, 64], 1.0, temperatures).ok_or("a grid has cells")?;
    Ok(ascii_grid::write(&Path::new(&out).join("temperature.asc"), &grid)?)
}
